"""Pictures of the food: its moments, and the pieces at the end."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba

from . import style, teeth

# More particles than this are drawn as an image: squares would take minutes.
MOST_SQUARES = 60000

# A row of pictures has room for the label of its colours [inch].
LOWEST_ROW = 1.9


def spacing_of(points):
    """The lattice spacing [m] of the undeformed particles."""
    extent = points.max(axis=0) - points.min(axis=0)
    n = len(points)
    if n < 2:
        return 1e-4
    # n = (w/d + 1)(h/d + 1) for a filled rectangle, solved for d.
    w, h = extent
    s = w + h
    return (s + np.sqrt(s * s + 4.0 * (n - 1) * w * h)) / (2.0 * (n - 1))


def draw_particles(axes, points, spacing, colours):
    """Draws particles as squares of one spacing, at points [mm]."""
    half = 0.52 * spacing  # no light through the seams
    if len(points) <= MOST_SQUARES:
        corners = half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        axes.add_collection(PolyCollection(
            points[:, None, :] + corners[None], facecolors=colours,
            edgecolors="none", rasterized=True, antialiaseds=False))
        return
    lower, upper = points.min(axis=0) - half, points.max(axis=0) + half
    cell = max(spacing, float((upper - lower).max()) / 700)
    shape = np.ceil((upper - lower) / cell).astype(int)
    index = np.minimum(((points - lower) / cell).astype(int), shape - 1)
    image = np.zeros((shape[1], shape[0], 4))
    image[index[:, 1], index[:, 0]] = colours
    axes.imshow(image, origin="lower", interpolation="nearest",
                extent=(lower[0], lower[0] + shape[0] * cell,
                        lower[1], lower[1] + shape[1] * cell))


def nearest(frames, time):
    """The frame nearest to a time, None without frames."""
    return min(frames, key=lambda f: abs(f.time - time), default=None)


def draw_plates(axes, run, time, field=None, colours_of=None):
    """Draws the plates as they stood at a time; those that deform by what
    colours_of() makes of a field of theirs."""
    elastic = nearest(run.elastic_plates, time)
    deforms = set()
    if elastic is not None:
        deforms = draw_elastic_plates(axes, elastic, field, colours_of)
    frame = nearest(run.plates, time)
    nodes, cells = ((frame.points(), frame.read("cells")) if frame
                    else (None, None))
    if nodes is None or cells is None or np.ndim(cells) != 2:
        return
    cells, plate = cells.astype(int), frame.read("plate")
    if plate is not None:
        cells = cells[~np.isin(plate[cells[:, 0]].astype(int), list(deforms))]
    if len(cells):
        teeth.draw(axes, nodes, cells, style.PLATE)


def draw_elastic_plates(axes, frame, field, colours_of):
    """Draws the cells of plates that deform; the numbers of these plates."""
    nodes, cells = frame.points(), frame.read("cells")
    plate = frame.read("plate")
    if nodes is None or cells is None or np.ndim(cells) != 2 or plate is None:
        return set()
    cells = cells.astype(int)
    values = frame.read(field) if colours_of is not None else None
    colours = (style.PLATE if values is None
               else colours_of(values[cells].mean(axis=1)))
    teeth.draw(axes, nodes, cells, colours)
    return set(np.unique(plate).astype(int))


def extent_of(frames):
    """The view [mm] in which all moments fit, clear of single escapers."""
    lower, upper = [], []
    for frame in frames:
        points = 1e3 * frame.points()
        lower.append(np.percentile(points, 0.3, axis=0))
        upper.append(np.percentile(points, 99.7, axis=0))
    lower, upper = np.min(lower, axis=0), np.max(upper, axis=0)
    margin = 0.10 * (upper - lower).max()
    return lower - margin, upper + margin


def set_view(axes, view):
    """Equal scales, no ticks: the scale bar says how large things are."""
    axes.set_xlim(view[0][0], view[1][0])
    axes.set_ylim(view[0][1], view[1][1])
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def scale_bar(axes, view):
    """A bar of a round length in the lower left corner."""
    width = view[1][0] - view[0][0]
    length = 10.0 ** np.floor(np.log10(width / 4))
    length *= max(m for m in (1, 2, 5) if m * length <= width / 4)
    x, y = view[0][0] + 0.03 * width, view[0][1] - 0.06 * width
    axes.plot([x, x + length], [y, y], color=style.INK, lw=2.5, clip_on=False,
              solid_capstyle="butt")
    axes.annotate(f"{length:g} mm", (x + length, y), xytext=(5, 0),
                  textcoords="offset points", va="center", fontsize=8.5,
                  annotation_clip=False)


def choose_moments(run, frames):
    """Up to four frames that tell the story: [(title, frame)]."""
    times = np.array([f.time for f in frames])
    force, t = run.mean_force(), run.column("time")
    peak = run.peak_time()
    wanted = []
    if peak is not None:
        before = t <= peak
        rise = np.argmax(force[before] >= 0.5 * force.max())
        wanted.append(("On the way to the peak", float(t[rise])))
        wanted.append(("Just before the peak", peak))
        low = np.flatnonzero((t > peak) & (force < 0.5 * force.max()))
        if len(low):
            wanted.append(("Breaking", float(t[low[0]])))
    else:
        wanted += [("Start", times[0]), ("Half way", times.mean())]
    wanted.append(("At the end", times[-1]))
    moments, used = [], set()
    for title, time in wanted:
        if title.startswith("Just before"):
            # A moment later the stress that broke the food has gone.
            index = max(int(np.searchsorted(times, time, "right")) - 1, 0)
        elif title == "Breaking":
            index = min(int(np.searchsorted(times, time)), len(times) - 1)
        else:
            index = int(np.argmin(np.abs(times - time)))
        if index not in used:
            used.add(index)
            moments.append((title, frames[index]))
    return moments


def caption(run, title, frame):
    """What is written above a moment."""
    parts = [style.quantity(frame.time, "s", 3)]
    strain = run.at("nominal_strain", frame.time)
    if strain is not None:
        parts.append(f"{100 * strain:.1f}\u202f% closed")
    if run.mean_force() is not None:
        force = float(np.interp(frame.time, run.column("time"),
                                run.mean_force()))
        parts.append(style.quantity(force, "N", 3))
    return title + "\n" + " · ".join(parts)


def moments(run):
    """The food at several moments, by damage and by stress; None without."""
    frames, _ = run.food()
    if not frames or frames[0].points() is None:
        return None
    chosen = choose_moments(run, frames)
    rows = [(field, label, cmap) for field, label, cmap in (
        ("damage", "Damage", style.DAMAGE),
        ("von_mises", "Von Mises stress", style.STRESS),
        ("stress_yy", "Axial stress", "RdBu"))
        if chosen[-1][1].read(field) is not None][:2]
    if not rows:
        rows = [(None, "Particles", None)]
    spacing = 1e3 * spacing_of(frames[0].points())
    view = teeth.with_teeth(run, extent_of([f for _, f in chosen]))
    aspect = (view[1][1] - view[0][1]) / (view[1][0] - view[0][0])
    width = 9.6 / (len(chosen) + 0.35)
    figure, grid = plt.subplots(
        len(rows), len(chosen), squeeze=False, layout="constrained",
        figsize=(9.6, len(rows) * max(width * aspect, LOWEST_ROW) + 0.75))
    for r, (field, label, cmap) in enumerate(rows):
        draw_row(figure, grid[r], run, chosen, field, label, cmap, spacing,
                 view)
    for axes, (title, frame) in zip(grid[0], chosen):
        axes.set_title(caption(run, title, frame), fontsize=9.5)
    scale_bar(grid[-1][0], view)
    # With axes of a fixed aspect the layout settles at the second pass.
    figure.draw_without_rendering()
    return figure


def draw_row(figure, row, run, chosen, field, label, cmap, spacing, view):
    """One quantity at all the moments, on one scale."""
    factor, unit, scale = 1.0, "", (0.0, 1.0)
    if field not in (None, "damage"):
        values = np.concatenate([f.read(field) for _, f in chosen])
        top = float(np.percentile(np.abs(values), 99)) or 1.0
        factor, unit = style.prefix_of(top, "Pa")
        scale = (-top * factor if field == "stress_yy" else 0.0, top * factor)
    surfaces = [nearest(run.surfaces, f.time) for _, f in chosen]
    surfaces = [f for f in surfaces if f is not None]
    largest = teeth.largest_force(run, surfaces)
    norm = plt.Normalize(*scale)
    mapper = plt.cm.ScalarMappable(norm, cmap or "Greys")
    for axes, (_, frame) in zip(row, chosen):
        points = 1e3 * frame.points()
        colours = (np.tile(to_rgba("#c9a26b"), (len(points), 1))
                   if field is None
                   else mapper.to_rgba(factor * frame.read(field)))
        draw_plates(axes, run, frame.time, field,
                    None if field in (None, "damage")
                    else lambda v: mapper.to_rgba(factor * v))
        draw_particles(axes, points, spacing, colours)
        if largest > 0:
            teeth.draw_forces(axes, run, nearest(run.surfaces, frame.time),
                              largest, view)
        set_view(axes, view)
    if field is not None:
        bar = figure.colorbar(
            mapper, ax=list(row), aspect=16, pad=0.01, shrink=0.86,
            extend={"damage": "neither", "stress_yy": "both"}.get(
                field, "max"))
        bar.set_label(label + (f" [{unit}]" if unit else " [0 to 1]"),
                      fontsize=9)
        bar.outline.set_visible(False)
        bar.ax.tick_params(labelsize=8.5, length=2)


def fragment_colours(labels, count):
    """A colour per particle: fragments in turn, crumbs and dust grey."""
    palette = np.array([to_rgba(c) for c in style.FRAGMENTS])
    labels = labels.astype(int)
    colours = palette[labels % len(palette)]
    colours[labels >= count] = to_rgba(style.CRUMB)
    colours[labels < 0] = to_rgba(style.DUST)
    return colours


def fragment_count(run, labels):
    """How many of the labels are fragments; the rest are crumbs."""
    count = run.value("fragment_count")
    return int(labels.max()) + 1 if count is None else int(count)


def fragments(run):
    """The pieces at the end beside where they were; None without labels."""
    frames, _ = run.food()
    if not frames or frames[-1].read("fragment") is None:
        return None
    labels = frames[-1].read("fragment")
    count = fragment_count(run, labels)
    colours = fragment_colours(labels, count)
    spacing = 1e3 * spacing_of(frames[0].points())
    start, end = 1e3 * frames[0].points(), 1e3 * frames[-1].points()
    same = len(start) == len(end)
    view = teeth.with_teeth(run, extent_of([frames[-1], frames[0]]))
    aspect = (view[1][1] - view[0][1]) / (view[1][0] - view[0][0])
    figure, grid = plt.subplots(
        1, 2 if same else 1, squeeze=False, layout="constrained",
        figsize=(9.6, 0.55 + 4.8 * min(aspect, 1.5)))
    pictures = [("Where the pieces are at the end", end, frames[-1])]
    if same:
        pictures.append(("Where they were in the whole block", start,
                         frames[0]))
    for axes, (title, points, frame) in zip(grid[0], pictures):
        draw_plates(axes, run, frame.time)
        draw_particles(axes, points, spacing, colours)
        number_fragments(axes, points, labels, count)
        set_view(axes, view)
        axes.set_title(title, fontsize=10)
    scale_bar(grid[0][0], view)
    return figure


def number_fragments(axes, points, labels, count):
    """Writes the rank on the largest pieces, at a particle of each."""
    for fragment in range(min(count, 20)):
        members = points[labels == fragment]
        if len(members) < 12:
            continue
        middle = np.median(members, axis=0)
        place = members[np.argmin(((members - middle) ** 2).sum(axis=1))]
        axes.text(*place, str(fragment + 1), ha="center", va="center",
                  fontsize=8.5, color=style.INK,
                  bbox={"boxstyle": "circle,pad=0.22", "fc": "white",
                        "ec": "none", "alpha": 0.85})
