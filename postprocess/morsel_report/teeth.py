"""What teeth look like, and what their surfaces feel."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from . import style
from .curves import PLATE_COLOURS, plate_label
from .reader import read_table

# Arrows are at most this share of the view's height.
LONGEST_ARROW = 0.18


def edges_of(nodes, cells):
    """The outer edges of cells, (n, 2, 2): those that belong to one cell.

    Cells do not share nodes: these are told apart by their places.
    """
    grid = np.round(nodes[cells] / 1e-9).astype(np.int64)
    seen = {}
    for corners, places in zip(nodes[cells], grid):
        for k in range(len(places)):
            one, two = k, (k + 1) % len(places)
            key = tuple(sorted((tuple(places[one]), tuple(places[two]))))
            if key[0] != key[1]:
                seen.setdefault(key, []).append(corners[[one, two]])
    single = np.array([e[0] for e in seen.values() if len(e) == 1])
    return single[~divided(single)] if len(single) else single


def divided(edges):
    """Which edges are those of a cell and of smaller ones beside it, which
    share it in parts: they lie inside."""
    start, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    length = np.hypot(along[:, 0], along[:, 1])
    inside = np.zeros(len(edges), bool)
    for i in range(len(edges)):
        way = edges - start[i]
        place = way @ along[i] / length[i] ** 2
        off = (way[..., 0] * along[i, 1] - way[..., 1] * along[i, 0]
               ) / length[i] ** 2
        parts = ((np.abs(off) < 1e-3) & (np.abs(place - 0.5) < 0.501)
                 ).all(axis=1) & (length < 0.95 * length[i])
        if abs(np.sum(length[parts]) / length[i] - 1.0) < 0.01:
            inside[i] = True
            inside |= parts
    return inside


def draw(axes, nodes, cells, colours):
    """Draws cells [m] filled, in mm, and their outline."""
    axes.add_collection(PolyCollection(
        1e3 * nodes[cells], facecolors=colours, edgecolors="none",
        antialiaseds=False, rasterized=True, zorder=0))
    axes.add_collection(LineCollection(
        1e3 * edges_of(nodes, cells), colors=style.INK, lw=0.6, zorder=0.5))


def with_teeth(run, view):
    """The view of the food [mm], grown so that it shows what lies around it
    and holds the arrows."""
    if not run.surfaces:
        return view
    nodes = 1e3 * run.surfaces[0].points()
    size = view[1] - view[0]
    grown = np.array([0.05, LONGEST_ARROW + 0.04]) * size
    lower = np.maximum(view[0] - grown, nodes.min(axis=0) - 0.05 * size)
    upper = np.minimum(view[1] + grown, nodes.max(axis=0) + 0.05 * size)
    # The arrows have their room even where there is only a thin plate.
    room = np.array([0.0, LONGEST_ARROW]) * size
    return (np.minimum(np.minimum(lower, view[0]), view[0] - room),
            np.maximum(np.maximum(upper, view[1]), view[1] + room))


def loads(frame, depth):
    """{plate: (force [N], centre of the load [m])} of a surfaces' frame."""
    nodes, cells = frame.points(), frame.read("cells")
    traction, plate = frame.read("traction"), frame.read("plate")
    if any(x is None for x in (nodes, cells, traction, plate)):
        return {}
    cells = cells.astype(int)
    length = np.linalg.norm(nodes[cells[:, 1]] - nodes[cells[:, 0]], axis=1)
    force = depth * length[:, None] * traction[cells].mean(axis=1)
    size = np.linalg.norm(force, axis=1)
    middle = nodes[cells].mean(axis=1)
    result = {}
    for number in np.unique(plate).astype(int):
        mine = plate[cells[:, 0]] == number
        if size[mine].sum() > 0:
            centre = (size[mine, None] * middle[mine]).sum(axis=0)
            result[number] = (force[mine].sum(axis=0),
                              centre / size[mine].sum())
    return result


def depth_of(run):
    """Extent out of the plane [m]."""
    try:
        return float(run.parameter("Depth", "1"))
    except ValueError:
        return 1.0


def draw_forces(axes, run, frame, largest, view):
    """The force of the food on each tooth, an arrow at its centre.

    frame: of the surfaces; largest: the force of the longest arrow [N].
    """
    for force, centre in loads(frame, depth_of(run)).values():
        size = np.linalg.norm(force)
        if not size > 0.02 * largest:
            continue
        way = LONGEST_ARROW * (view[1][1] - view[0][1]) * force / largest
        tail = 1e3 * centre
        axes.annotate("", tail + way, tail, zorder=6, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>,head_width=0.25,"
                                  "head_length=0.5", "lw": 1.8,
                                  "color": style.SKY,
                                  "shrinkA": 0, "shrinkB": 0})
        axes.annotate(style.quantity(size, "N", 2), tail + way,
                      xytext=(5, 0), textcoords="offset points",
                      va="center", fontsize=7.5, color=style.INK,
                      zorder=7, annotation_clip=False,
                      bbox={"boxstyle": "round,pad=0.15", "fc": "white",
                            "ec": "none", "alpha": 0.8})


def largest_force(run, frames):
    """The largest force on a tooth at some moments [N]."""
    return max((np.linalg.norm(force) for frame in frames
                for force, _ in loads(frame, depth_of(run)).values()),
               default=0.0)


def tractions(run):
    """Pressure and shear along each surface at the peak; None without."""
    table, _ = read_table(run.folder / "surface_forces.csv")
    if not table or not np.max(table["normal_pressure"]) > 0:
        return None
    names = run.plate_names()
    plates = [p for p in np.unique(table["plate"]).astype(int)
              if np.max(table["normal_pressure"][table["plate"] == p]) > 0]
    factor, unit = style.prefix_of(np.max(table["normal_pressure"]), "Pa")
    figure, grid = plt.subplots(
        1, len(plates), squeeze=False, sharey=True, layout="constrained",
        figsize=(1.2 + 4.2 * len(plates), 3.6))
    for axes, plate in zip(grid[0], plates):
        mine = {n: v[table["plate"] == plate] for n, v in table.items()}
        draw_traction(axes, mine, factor, PLATE_COLOURS[plate % 4])
        if plate < len(names):
            axes.set_title(plate_label(names[plate]))
    grid[0][0].set_ylabel(f"Traction [{unit}]")
    grid[0][0].legend(loc="best")
    return figure


def draw_traction(axes, table, factor, colour):
    """One surface's pressure and shear over the way from its centre."""
    pressure = table["normal_pressure"]
    arc, length = unrolled(table)
    order = np.argsort(arc)
    axes.fill_between(1e3 * arc[order], 0, factor * pressure[order],
                      color=colour, alpha=0.25, lw=0)
    axes.plot(1e3 * arc[order], factor * pressure[order], color=colour,
              label="normal pressure")
    axes.plot(1e3 * arc[order], factor * table["tangential_traction"][order],
              color=style.INK, lw=1.0, label="tangential traction")
    loaded = np.abs(arc[pressure > 0.01 * pressure.max()]).max()
    reach = min(0.5 * length, max(1.3 * loaded, 0.02 * length))
    axes.set_xlim(-1e3 * reach, 1e3 * reach)
    axes.set_xlabel("Way along the surface from the middle of contact [mm]")


def unrolled(table):
    """Ways along the surface from the middle of contact, and the way once
    around [m]."""
    arc, pressure = table["arc_length"], np.maximum(table["normal_pressure"],
                                                    0)
    gaps = np.hypot(np.diff(table["x"]), np.diff(table["y"]))
    closing = np.hypot(table["x"][0] - table["x"][-1],
                       table["y"][0] - table["y"][-1])
    length = gaps.sum() + closing
    turn = np.exp(2j * np.pi * arc / length)
    middle = np.angle((pressure * turn).sum()) * length / (2 * np.pi)
    return (arc - middle + 0.5 * length) % length - 0.5 * length, length
