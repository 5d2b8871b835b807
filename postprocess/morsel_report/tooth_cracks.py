"""Cracks in elastic teeth: K over time, and whether they would grow."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

from . import food, style

PREFIX = "stress_intensity_I_"
COLOURS = [style.BLUE, style.ORANGE, style.GREEN, style.PURPLE]


def tips(run):
    """What follows the names of quantities at each tip, as lower_tooth_tip1."""
    return [n[len(PREFIX):] for n in run.history if n.startswith(PREFIX)]


def plate_of(run, tip):
    """The plate that a tip belongs to: the longest name that it begins with."""
    names = [n for n in run.plate_names() if tip.startswith(n)]
    return max(names, key=len, default=None)


def label(run, tip):
    """lower_tooth_tip1 as "lower tooth, tip 1"."""
    plate = plate_of(run, tip) or tip
    rest = tip[len(plate):].replace("_crack", ", crack ")
    return (plate + rest.replace("_tip", ", tip ")).replace("_", " ")


def stress_intensity_over_time(run):
    """K_I and K_II at each tip with the toughness, and the force behind."""
    t, names = run.column("time"), tips(run)
    if t is None or len(t) < 2 or not names:
        return None
    toughness = sorted({run.value("fracture_toughness_" + n) for n in names}
                       - {None})
    modes = {n: (run.column(PREFIX + n),
                 run.column(PREFIX.replace("_I_", "_II_") + n))
             for n in names}
    top = max(np.max(np.abs(k)) for pair in modes.values() for k in pair)
    factor, unit = style.prefix_of(max([top] + toughness), "Pa")
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    figure, axes = plt.subplots(figsize=(9.6, 4.2), layout="constrained")
    behind = axes.twinx()
    axes.set_zorder(behind.get_zorder() + 1)
    axes.patch.set_visible(False)
    for plate in sorted({plate_of(run, n) for n in names} - {None}):
        behind.fill_between(time_factor * t, run.column("force_" + plate),
                            color=style.DUST, lw=0, alpha=0.5)
    behind.set_ylabel("Force on the tooth [N]", color=style.CRUMB)
    behind.spines["right"].set_visible(True)
    behind.grid(False)
    for i, name in enumerate(names):
        colour = COLOURS[i % len(COLOURS)]
        for k, mode, dash in zip(modes[name], ("I", "II"),
                                 ("-", (0, (5, 2)))):
            axes.plot(time_factor * t, factor * k, color=colour, ls=dash,
                      label=f"$K_{{{mode}}}$, {label(run, name)}")
        growth = run.value("time_of_crack_growth_" + name)
        if growth is not None:
            at = factor * run.at(PREFIX + name, growth)
            axes.plot(time_factor * growth, at, "o", ms=6, color=style.INK,
                      zorder=6)
            axes.annotate("would grow", (time_factor * growth, at),
                          xytext=(-8, 6), ha="right", fontsize=9,
                          textcoords="offset points")
    for value in toughness:
        axes.axhline(factor * value, color=style.RED, lw=1.2, ls=(0, (5, 3)))
        axes.annotate("toughness $K_{Ic}$", (1, factor * value),
                      xycoords=("axes fraction", "data"), xytext=(-4, 4),
                      textcoords="offset points", ha="right", fontsize=9,
                      color=style.RED)
    axes.set_xlim(0, time_factor * t.max())
    low, high = axes.get_ylim()
    high += 0.06 * (high - low)
    axes.set_ylim(low, high)
    # One zero for both.
    force = behind.get_ylim()[1]
    behind.set_ylim(low / high * force, force)
    axes.set_xlabel(f"Time [{time_unit}]")
    axes.set_ylabel(f"Stress intensity [{unit} √m]")
    axes.legend(loc="center right")
    return figure


def open_cracks(run):
    """The cracked teeth when K was largest: stress, with the deformation
    magnified so that the cracks are open."""
    names = tips(run)
    if not names or not run.elastic_plates:
        return None
    worst = max(names, key=lambda n: run.value(
        "largest_equivalent_stress_intensity_" + n, 0.0))
    time = run.value("time_of_largest_equivalent_stress_intensity_" + worst)
    frame = food.nearest(run.elastic_plates, time or 0.0)
    nodes, cells = frame.points(), frame.read("cells")
    moved, stress = frame.read("displacement"), frame.read("von_mises")
    largest = np.max(np.abs(moved), initial=0.0)
    if largest == 0.0:
        return None
    cells = cells.astype(int)
    times = 0.03 * np.max(np.ptp(nodes, axis=0)) / largest
    times = float(f"{times:.1g}")
    corners = 1e3 * (nodes + (times - 1.0) * moved[:, :2])[cells]
    factor, unit = style.prefix_of(np.percentile(stress, 98), "Pa")
    colours = ScalarMappable(
        Normalize(0, factor * np.percentile(stress, 98)), "viridis")
    figure, axes = plt.subplots(figsize=(9.6, 3.2), layout="constrained")
    axes.add_collection(PolyCollection(
        corners, facecolors=colours.to_rgba(
            factor * stress[cells].mean(axis=1)),
        edgecolors="none", antialiaseds=False, rasterized=True))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")
    axes.set_title(f"{style.quantity(frame.time, 's', 3)} · deformation "
                   f"{times:g} times its size", loc="left", fontsize=10)
    figure.colorbar(colours, ax=axes, extend="max", shrink=0.8,
                    label=f"Von Mises stress [{unit}]")
    return figure


def outcome(run):
    """Whether cracks would grow, in a sentence for each tooth."""
    sentences = []
    for plate in sorted({plate_of(run, n) for n in tips(run)} - {None}):
        mine = [n for n in tips(run) if plate_of(run, n) == plate]
        grown = [n for n in mine if run.value("crack_would_grow_" + n)]
        tooth = plate.replace("_", " ")
        if grown:
            first = min(grown,
                        key=lambda n: run.value("time_of_crack_growth_" + n))
            force = run.value("force_at_crack_growth_" + first)
            sentences.append(f"The crack in the {tooth} would grow from a "
                             f"force of {style.quantity(force, 'N', 3)} on.")
            continue
        worst = max(mine, key=lambda n: run.value(
            "largest_equivalent_stress_intensity_" + n, 0.0))
        largest = run.value("largest_equivalent_stress_intensity_" + worst)
        toughness = run.value("fracture_toughness_" + worst)
        if largest is not None and toughness:
            sentences.append(f"The crack in the {tooth} would not grow: its K "
                             f"reached {style.percent(largest / toughness)} "
                             "of the toughness.")
    return sentences
