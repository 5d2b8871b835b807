"""What the page tells of particle bodies in static equilibrium."""
import html

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

from . import plate, style
from .tables import warnings_of  # noqa: F401 (part of every story)

KICKER = "MORSEL · particle bodies in static equilibrium"
# More cells than this are drawn without their edges and particles.
MOST_OUTLINED = 6000


def drawn_size(points, width=8.6, bar=0.0):
    """A figure's size in which the points fill the width, or the height."""
    extent = np.ptp(points, axis=0)
    height = (width - bar) * extent[1] / extent[0] + 0.7
    return width, min(max(height, 2.4), 8.0)


def draw_outlines(axes, run, **line):
    """The bodies' boundaries where they were [mm]."""
    for _, outline in run.static_bodies.values():
        if outline is None:
            continue
        for loop in outline.polygons():
            axes.plot(*(1e3 * loop).T, **{"color": "#9a9a9a", "lw": 0.9,
                                          "ls": (0, (4, 3)), **line})


def enlargement(run):
    """A round factor that makes the displacements visible."""
    grids = [cells for cells, _ in run.static_bodies.values()]
    size = max(np.ptp(g.points, axis=0).max() for g in grids)
    largest = max(np.abs(g.point_fields["displacement"]).max() for g in grids)
    return plate.round_number(0.09 * size / largest) if largest > 0 else 1.0


def deformed(run):
    """The bodies deformed, by von Mises stress."""
    grids = [cells for cells, _ in run.static_bodies.values()]
    if not grids:
        return None
    top = max(plate.nominal_top(g, g.point_fields["von_mises_stress"])
              for g in grids)
    factor, unit = style.prefix_of(top, "Pa")
    scale = enlargement(run)
    moved = [1e3 * (g.points + scale * g.point_fields["displacement"][:, :2])
             for g in grids]
    everything = np.concatenate(moved + [1e3 * g.points for g in grids])
    figure, axes = plt.subplots(figsize=drawn_size(everything, bar=1.2),
                                layout="constrained")
    for grid, points in zip(grids, moved):
        mapper = plate.shade(
            axes, grid, points, factor * grid.point_fields["von_mises_stress"],
            cmap=style.STRESS, vmin=0, vmax=factor * top)
    draw_outlines(axes, run)
    plate.bare(axes)
    axes.set_title(f"Displacements drawn {scale:g} times as large; dashed: "
                   "undeformed", fontsize=9.5)
    plate.length_bar(axes, (everything.min(axis=0), everything.max(axis=0)))
    plate.colour_bar(figure, mapper, axes, f"Von Mises stress [{unit}]",
                     shrink=0.85)
    return figure


def stresses(run):
    """The three components of stress."""
    grids = [cells for cells, _ in run.static_bodies.values()]
    if not grids:
        return None
    everything = 1e3 * np.concatenate([g.points for g in grids])
    extent = np.ptp(everything, axis=0)
    wide = extent[0] > 2.2 * extent[1]
    rows, columns = (3, 1) if wide else (1, 3)
    width = 8.6 if wide else 9.6
    one = (width / columns - 0.8) * extent[1] / extent[0] + 0.6
    figure, grid_of_axes = plt.subplots(
        rows, columns, figsize=(width, rows * min(max(one, 1.4), 4.5)),
        layout="constrained", squeeze=False)
    for axes, (k, name) in zip(grid_of_axes.flat,
                               ((0, "xx"), (1, "yy"), (3, "xy"))):
        values = [g.point_fields["stress_xx_yy_zz_xy"][:, k] for g in grids]
        top = float(np.percentile(np.abs(np.concatenate(values)), 99.5)) or 1.0
        factor, unit = style.prefix_of(top, "Pa")
        for grid, value in zip(grids, values):
            mapper = plate.shade(axes, grid, 1e3 * grid.points, factor * value,
                                 cmap="RdBu_r", vmin=-factor * top,
                                 vmax=factor * top)
        draw_outlines(axes, run, ls="-", lw=0.7)
        plate.bare(axes)
        plate.colour_bar(figure, mapper, axes, f"Stress {name} [{unit}]",
                         extend="both", shrink=0.8)
    return figure


def filling(run):
    """The particles' cells by their area over the mean."""
    if not run.static_bodies:
        return None
    grids = [cells for cells, _ in run.static_bodies.values()]
    everything = 1e3 * np.concatenate([g.points for g in grids])
    figure, axes = plt.subplots(figsize=drawn_size(everything, bar=1.2),
                                layout="constrained")
    count = sum(len(g.offsets) for g in grids)
    outlined = count <= MOST_OUTLINED
    for grid in grids:
        area = grid.cell_fields["area"]
        cells = PolyCollection(
            [1e3 * p for p in grid.polygons()], cmap="RdBu_r",
            edgecolors="#666666" if outlined else "none",
            linewidths=0.3 if outlined else 0.0, rasterized=True)
        cells.set_array(area / area.mean())
        cells.set_clim(0.5, 1.5)
        axes.add_collection(cells)
    draw_outlines(axes, run, ls="-", lw=1.0, color=style.INK)
    axes.autoscale_view()
    plate.bare(axes)
    plate.length_bar(axes, (everything.min(axis=0), everything.max(axis=0)))
    plate.colour_bar(figure, cells, axes, "Area of a cell over the mean",
                     extend="both", shrink=0.85)
    return figure


FIGURES = [
    ("deformed", deformed,
     "The bodies in equilibrium, by von Mises stress. Every particle's cell is "
     "drawn with the displacements that the particle sees at its corners.",
     True),
    ("stresses", stresses,
     "The components of stress on the undeformed bodies.", True),
    ("filling", filling,
     "The particles' cells, by their area over the mean: how even the filling "
     "is.", True),
]

SECTIONS = [
    ("The bodies in equilibrium", ["deformed", "stresses"]),
    ("How they are filled", ["filling"]),
]

CARDS = [
    ("strain_energy", "strain energy"),
    ("energy_balance_error", "difference of work and strain energy"),
    ("equilibrium_residual", "forces out of balance over loads and reactions"),
    ("support_gap", "largest error of what supports hold, over the largest "
                    "displacement"),
]


def outcome(run):
    """What was found, in a sentence."""
    count, steps = run.value("particle_count"), run.value("solver_iterations")
    if None in (count, steps):
        return ""
    return (f"{int(count)} particles in equilibrium after {int(steps)} "
            "iterations.")


def tables(run):
    """What was observed beside what is expected."""
    rows = []
    for name, entry in run.results().items():
        if not name.startswith(("displacement_", "stress_")) or (
                "reference" not in entry):
            continue
        unit = entry.get("unit", "1")
        rows.append(
            f"<tr><td>{html.escape(name.replace('_', ' '))}</td>"
            f'<td class="n">{style.quantity(entry["value"], unit)}</td>'
            f'<td class="n">{style.quantity(entry["reference"], unit)}</td>'
            f'<td class="n">{style.percent(entry["error"])}</td></tr>')
    if not rows:
        return []
    return ["<h2>Against what is known</h2><table><thead><tr><th>Observed</th>"
            '<th class="n">Found</th><th class="n">Expected</th>'
            '<th class="n">Error, of the largest component</th></tr></thead>'
            f"<tbody>{''.join(rows)}</tbody></table>"]
