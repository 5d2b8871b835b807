"""Pictures and curves of a cracked plate."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Circle

from . import style

# More triangles than this are drawn flat: shading them would take minutes.
MOST_SHADED = 200000
# Tips beyond these are in the tables, not in the pictures.
MOST_TIPS = 4
KINDS = [(1, "jump", style.BLUE, "o"), (2, "tip functions", style.RED, "s"),
         (3, "both", style.PURPLE, "D")]


def round_number(x):
    """The largest of 1, 2, 5 times a power of ten that is not above x."""
    power = 10.0 ** np.floor(np.log10(x))
    return max(m for m in (1, 2, 5) if m * power <= x * 1.000001) * power


def nominal_top(grid, values):
    """A top for the colours: what 99 percent of the plate stays below."""
    triangles = grid.triangles()
    p = grid.points[triangles]
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    mean = values[triangles].mean(axis=1)
    order = np.argsort(mean)
    share = np.cumsum(area[order]) / area.sum()
    return float(mean[order][np.searchsorted(share, 0.99)]) or 1.0


def shade(axes, grid, points, values, **colours):
    """Colours a grid whose cells do not share points."""
    triangles = grid.triangles()
    shading = "gouraud" if len(triangles) <= MOST_SHADED else "flat"
    return axes.tripcolor(points[:, 0], points[:, 1], triangles, values,
                          shading=shading, rasterized=True, **colours)


def bare(axes):
    """Equal scales, no ticks, no frame."""
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def colour_bar(figure, mapper, axes, label, extend="max", **more):
    """A bar without a frame."""
    bar = figure.colorbar(mapper, ax=axes, extend=extend, pad=0.015,
                          aspect=22, **more)
    bar.set_label(label, fontsize=9)
    bar.outline.set_visible(False)
    bar.ax.tick_params(labelsize=8.5, length=2)


def draw_cracks(axes, run, **line):
    """The cracks as lines [mm]."""
    if run.cracks is None:
        return
    for crack in run.cracks.polygons():
        axes.plot(*(1e3 * crack).T, **{"color": style.INK, "lw": 1.6,
                                       "solid_capstyle": "round", **line})


def length_bar(axes, view, share=0.25):
    """A bar of a round length, at most a share of the width, below."""
    width = view[1][0] - view[0][0]
    length = round_number(share * width)
    y = view[0][1] - 0.05 * (view[1][1] - view[0][1])
    axes.plot([view[0][0], view[0][0] + length], [y, y], color=style.INK,
              lw=2.5, clip_on=False, solid_capstyle="butt")
    label = f"{length:g} mm" if length < 1000 else f"{length / 1000:g} m"
    axes.annotate(label, (view[0][0] + length, y), xytext=(5, 0),
                  textcoords="offset points", va="center", fontsize=8.5,
                  annotation_clip=False)


def magnification(run):
    """A round factor that makes the displacements visible."""
    grid = run.plate
    u = grid.point_fields["displacement"][:, :2]
    size = np.ptp(grid.points, axis=0).max()
    largest = np.abs(u - u.mean(axis=0)).max()
    return round_number(0.09 * size / largest) if largest > 0 else 1.0


def deformed(run):
    """The deformed plate, its cracks open, by von Mises stress."""
    grid = run.plate
    if grid is None:
        return None
    stress = grid.point_fields["von_mises_stress"]
    top = nominal_top(grid, stress)
    factor, unit = style.prefix_of(top, "Pa")
    scale = magnification(run)
    moved = 1e3 * (grid.points
                   + scale * grid.point_fields["displacement"][:, :2])
    lower, upper = 1e3 * grid.points.min(axis=0), 1e3 * grid.points.max(axis=0)
    extent = np.ptp(moved, axis=0)
    height = min(max(7.0 * extent[1] / extent[0], 2.6), 8.4)
    figure, axes = plt.subplots(figsize=(8.6, height), layout="constrained")
    axes.add_patch(plt.Rectangle(lower, *(upper - lower), fill=False,
                                 ec="#9a9a9a", lw=0.9, ls=(0, (4, 3))))
    mapper = shade(axes, grid, moved, factor * stress, cmap=style.STRESS,
                   vmin=0, vmax=factor * top)
    draw_cracks(axes, run, color="#9a9a9a", lw=0.9, ls=(0, (4, 3)))
    bare(axes)
    view = (np.minimum(lower, moved.min(axis=0)),
            np.maximum(upper, moved.max(axis=0)))
    axes.set_title(f"Displacements {scale:g} times enlarged; dashed: "
                   "undeformed", fontsize=9.5)
    length_bar(axes, view)
    colour_bar(figure, mapper, axes, f"Von Mises stress [{unit}]",
               shrink=0.85)
    return figure


def von_mises(run, table, here, kind):
    """Von Mises stress of some rows of tip_stress.csv."""
    rr, tt, rt = (table[f"{kind}_{part}"][here] for part in ("rr", "tt",
                                                             "rt"))
    plane_stress = run.parameter("Plane stress", "false") == "true"
    nu = 0.0 if plane_stress else float(run.parameter("Poisson's ratio",
                                                      "0.3"))
    zz = nu * (rr + tt)
    return np.sqrt(0.5 * ((rr - tt) ** 2 + (tt - zz) ** 2 + (zz - rr) ** 2)
                   + 3 * rt ** 2)


def tip_field(run):
    """Von Mises stress about each tip, the singular field, the difference."""
    table, tips = run.tip_stress, run.tips[:MOST_TIPS]
    if "stress_tt" not in table or not tips:
        return None
    figure, rows = plt.subplots(
        len(tips), 3, squeeze=False, layout="constrained",
        figsize=(9.6, 0.4 + 2.75 * len(tips)))
    for row, tip in zip(rows, tips):
        here = (table["tip"] == tip.number) & (table["angle"] != 0)
        radii = np.unique(table["radius"][here])
        computed, singular = (
            von_mises(run, table, here, kind).reshape(len(radii), -1)
            for kind in ("stress", "asymptotic"))
        top = 1.5 * float(np.median(
            singular[np.searchsorted(radii, 0.15 * radii.max())]))
        factor, unit = style.prefix_of(top, "Pa")
        angle = (np.radians(table["angle"][here])
                 + np.arctan2(*tip.direction[::-1])).reshape(len(radii), -1)
        r = 1e3 * table["radius"][here].reshape(len(radii), -1)
        x, y = r * np.cos(angle), r * np.sin(angle)
        reach = 1.03 * r.max()
        scales = [dict(cmap=style.STRESS, vmin=0, vmax=factor * top)] * 2 + [
            dict(cmap="RdBu_r", vmin=-0.5 * factor * top,
                 vmax=0.5 * factor * top)]
        titles = ["computed", "singular field of the K measured",
                  "difference"]
        for axes, values, scale, title in zip(
                row, (computed, singular, computed - singular), scales,
                titles):
            mapper = axes.pcolormesh(x, y, factor * values,
                                     shading="gouraud", rasterized=True,
                                     **scale)
            axes.plot([-r.max() * tip.direction[0], 0],
                      [-r.max() * tip.direction[1], 0], color=style.INK,
                      lw=1.8, solid_capstyle="butt")
            bare(axes)
            axes.set_xlim(-reach, reach)
            axes.set_ylim(-reach, reach)
            axes.set_title(f"Tip {tip.number}: {title}", fontsize=9.5)
            if title.startswith("singular"):
                colour_bar(figure, mapper, list(row[:2]),
                           f"Von Mises stress [{unit}]", shrink=0.85)
            elif title == "difference":
                colour_bar(figure, mapper, axes, f"Difference [{unit}]",
                           extend="both", shrink=0.85)
        length_bar(row[0], ((-reach, -0.95 * reach), (reach, 0.95 * reach)),
                   share=0.2)
    return figure


def tip_lines(run):
    """Stress ahead of each tip and around it, with the singular field."""
    table, tips = run.tip_stress, run.tips[:MOST_TIPS]
    if "stress_tt" not in table or not tips:
        return None
    figure, rows = plt.subplots(len(tips), 2, squeeze=False,
                                layout="constrained",
                                figsize=(9.6, 0.3 + 3.0 * len(tips)))
    for (left, right), tip in zip(rows, tips):
        here = table["tip"] == tip.number
        ahead = here & (table["angle"] == 0)
        around = here & ~ahead
        radii = np.unique(table["radius"][around])
        circle = radii[np.searchsorted(radii, 0.25 * radii.max())]
        around &= table["radius"] == circle
        factor, unit = style.prefix_of(
            np.abs(table["stress_tt"][around]).max(), "Pa")
        r = 1e3 * table["radius"][ahead]
        for part, name, colour in (("tt", "opening stress", style.BLUE),
                                   ("rt", "shear stress", style.RED)):
            shown = np.abs(table["stress_" + part][ahead])
            if shown.max() > 1e-3 * np.abs(table["stress_tt"][ahead]).max():
                left.loglog(r, factor * shown, color=colour, label=name)
                left.loglog(r, factor * np.abs(
                    table["asymptotic_" + part][ahead]), color=style.INK,
                    lw=1.0, ls=(0, (4, 3)))
            angle = table["angle"][around]
            right.plot(angle, factor * table["stress_" + part][around],
                       color=colour,
                       label="across the ray" if part == "tt"
                       else "along the ray (shear)")
            right.plot(angle, factor * table["asymptotic_" + part][around],
                       color=style.INK, lw=1.0, ls=(0, (4, 3)))
        left.plot([], [], color=style.INK, lw=1.0, ls=(0, (4, 3)),
                  label="asymptotic")
        left.set_xlabel("Distance ahead of the tip [mm]")
        left.set_ylabel(f"Tip {tip.number}: stress [{unit}]")
        left.legend(loc="best")
        radius = 1e3 * table["radius"][around][0]
        right.set_xlabel(f"Angle on the circle of {radius:.3g} mm [degrees]")
        right.set_xticks(np.arange(-180, 181, 60))
        right.set_xlim(-180, 180)
        right.legend(loc="best")
    return figure


def cell_boxes(grid):
    """Lower and upper corners of the mesh's cells, which lie along x, y."""
    key = (grid.cell_fields["rank"] * (grid.cell_fields["cell"].max() + 1)
           + grid.cell_fields["cell"])
    _, owner = np.unique(key, return_inverse=True)
    sizes = grid.offsets - grid.starts()
    of_point = np.repeat(owner, sizes)
    n = owner.max() + 1
    lower, upper = np.full((n, 2), np.inf), np.full((n, 2), -np.inf)
    np.minimum.at(lower, of_point, grid.points)
    np.maximum.at(upper, of_point, grid.points)
    return lower, upper


def enrichment(run):
    """Mesh, enriched nodes and rings: the plate, and about its tips."""
    grid, nodes = run.plate, run.nodes
    if grid is None or nodes is None or "cell" not in grid.cell_fields:
        return None
    lower, upper = cell_boxes(grid)
    corners = 1e3 * np.stack(
        [lower, np.stack([upper[:, 0], lower[:, 1]], 1), upper,
         np.stack([lower[:, 0], upper[:, 1]], 1)], axis=1)
    low, high = 1e3 * lower.min(axis=0), 1e3 * upper.max(axis=0)
    views = [("The whole plate", low, high)]
    if run.tips:
        # About the tips, with whatever is enriched there.
        marks = [1e3 * nodes.points[nodes.point_fields["kind"] >= 2]]
        marks += [1e3 * (t.place + np.array([[s, s]]) * t.outer.max())
                  for t in run.tips for s in (-1, 1)]
        marks = np.concatenate([m for m in marks if len(m)])
        centre = 0.5 * (marks.min(axis=0) + marks.max(axis=0))
        half = 0.56 * np.ptp(marks, axis=0).max()
        views.append(("About the crack tips", np.maximum(centre - half, low),
                      np.minimum(centre + half, high)))
    figure, row = plt.subplots(1, len(views), squeeze=False,
                               layout="constrained", figsize=(9.6, 5.3))
    for k, (axes, (title, a, b)) in enumerate(zip(row[0], views)):
        axes.add_collection(PolyCollection(corners, facecolors="none",
                                           edgecolors="#b5b5b5", lw=0.5))
        for tip in run.tips:
            for inner, outer in zip(tip.inner, tip.outer):
                for radius, line in ((inner, (0, (2, 2))), (outer, "-")):
                    axes.add_patch(Circle(
                        1e3 * tip.place, 1e3 * radius, fill=False,
                        ec=style.ORANGE, lw=1.1, ls=line))
        draw_cracks(axes, run, lw=1.8)
        for kind, label, colour, marker in KINDS:
            here = nodes.point_fields["kind"] == kind
            if here.any():
                axes.plot(*(1e3 * nodes.points[here]).T, marker, ls="",
                          ms=2.5 if k == 0 else 4.5, color=colour,
                          label=label, mew=0)
        bare(axes)
        margin = 0.02 * (b - a).max()
        axes.set_xlim(a[0] - margin, b[0] + margin)
        axes.set_ylim(a[1] - margin, b[1] + margin)
        axes.set_title(title, fontsize=9.5)
        length_bar(axes, (a, b))
    handles, labels = row[0][-1].get_legend_handles_labels()
    if run.tips:
        handles.append(plt.Line2D([], [], color=style.ORANGE))
        labels.append("rings (dashed: inner edge)")
    if handles:
        row[0][-1].legend(handles, labels, loc="upper right", ncols=2,
                          bbox_to_anchor=(1.0, -0.015), borderaxespad=0,
                          fontsize=8.5, columnspacing=1.0, handletextpad=0.3)
    return figure


def ring_values(run):
    """K of every ring against its radius, as the difference from the truth
    where that is known, else from the mean."""
    tips = [t for t in run.tips if len(t.outer)]
    if not tips:
        return None
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    colours = [style.BLUE, style.RED, style.GREEN, style.PURPLE, style.SKY,
               style.ORANGE]
    known, radii = True, np.concatenate([t.outer for t in tips])
    factor, unit = style.prefix_of(radii.max(), "m")
    for k, tip in enumerate(tips):
        size = np.hypot(np.mean(tip.mode_I), np.mean(tip.mode_II)) or 1.0
        for name, values, marker in (("I", tip.mode_I, "o-"),
                                     ("II", tip.mode_II, "s--")):
            entry = run.results().get(
                f"stress_intensity_{name}" + tip.suffix(run.tips), {})
            known = known and "reference" in entry
            base = entry.get("reference", float(np.mean(values)))
            axes.plot(factor * tip.outer, (values - base) / size, marker,
                      ms=4.5, lw=1.2, color=colours[k % len(colours)],
                      label=f"$K_{{{name}}}$"
                      + (f", tip {tip.number}" if len(tips) > 1 else ""))
    axes.axhline(0, color=style.INK, lw=0.8)
    axes.set_xlabel(f"Outer radius of the ring [{unit}]")
    axes.set_ylabel("Difference from the "
                    + ("reference" if known else "mean, or the reference")
                    + "\nover |K|")
    axes.ticklabel_format(axis="y", scilimits=(-3, 3), useMathText=True)
    axes.legend(loc="best", ncols=2 if len(tips) > 1 else 1)
    return figure


def opening(run):
    """Opening and sliding of the faces behind each tip, with the root law."""
    table = run.opening
    if "opening" not in table or len(table["opening"]) == 0:
        return None
    numbers = np.unique(table["tip"])[:MOST_TIPS]
    top = max(np.abs(table["opening"]).max(), np.abs(table["sliding"]).max())
    factor, unit = style.prefix_of(top, "m")
    far, far_unit = style.prefix_of(table["distance"].max(), "m")
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    colours = [style.BLUE, style.RED, style.GREEN, style.PURPLE]
    for k, number in enumerate(numbers):
        here = table["tip"] == number
        r = far * table["distance"][here]
        suffix = f", tip {int(number)}" if len(numbers) > 1 else ""
        for name, line in (("opening", "-"), ("sliding", (0, (5, 2)))):
            values = table[name][here]
            if np.abs(values).max() < 1e-4 * top:
                continue
            axes.plot(r, factor * values, color=colours[k], ls=line,
                      label=name + suffix)
            axes.plot(r, factor * table["asymptotic_" + name][here],
                      color=style.INK, lw=0.9, ls=(0, (1, 1.5)))
    axes.plot([], [], color=style.INK, lw=0.9, ls=(0, (1, 1.5)),
              label=r"asymptotic $\propto\sqrt{r}$")
    axes.set_xlim(left=0)
    axes.set_xlabel(f"Distance behind the tip, along the crack [{far_unit}]")
    axes.set_ylabel(f"Distance of the faces [{unit}]")
    axes.legend(loc="best")
    return figure
