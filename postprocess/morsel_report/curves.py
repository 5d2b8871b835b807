"""Curves over the stroke: force, stress, energy, and the pieces' sizes."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from . import style

PLATE_COLOURS = [style.BLUE, style.ORANGE, style.GREEN, style.PURPLE]

# What the ledger stacks, from below: name in the history, label, colour.
STORED = [
    ("strain_energy", "strain", style.BLUE),
    ("contact_energy", "contact", style.SKY),
    ("granular_energy", "broken food (stored)", "#8FBCD4"),
    ("hourglass_energy", "hourglass control", "#C9DDEA"),
    ("kinetic_energy", "kinetic", style.GREEN),
    ("plate_strain_energy", "strain of the plates", "#9AA7B0"),
    ("plate_kinetic_energy", "kinetic, of the plates", "#CBD3D8"),
]
DISSIPATED = [
    ("dissipated_damage", "damage", style.RED),
    ("dissipated_bonds", "breaking bonds", "#F0B48A"),
    ("dissipated_viscosity", "viscosity", style.ORANGE),
    ("dissipated_damping", "damping", "#D9B44A"),
    ("dissipated_artificial_stress", "artificial stress", "#B07AA1"),
    ("dissipated_friction", "friction", style.PURPLE),
    ("dissipated_granular_friction", "friction of broken food", "#E3BFD3"),
]


def plate_label(name):
    """lower_plate as "lower plate"."""
    return name.replace("_", " ")


def force_over_time(run):
    """Normal force on each plate, its peak and the tangential part."""
    t, names = run.column("time"), run.plate_names()
    if t is None or not names or len(t) < 2:
        return None
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    top = max(np.max(np.abs(run.column("force_" + n))) for n in names)
    factor, unit = style.prefix_of(top, "N")
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    for k, name in enumerate(names):
        colour = PLATE_COLOURS[k % len(PLATE_COLOURS)]
        axes.plot(time_factor * t, factor * run.column("force_" + name),
                  color=colour, label=plate_label(name),
                  ls="-" if k == 0 else (0, (5, 2)))
        tangential = run.column("tangential_force_" + name)
        if tangential is not None and np.max(np.abs(tangential)) > 1e-3 * top:
            axes.plot(time_factor * t, factor * tangential, color=colour,
                      lw=1.0, ls=":",
                      label=plate_label(name) + ", tangential")
    mean = run.mean_force()
    i = int(np.argmax(mean))
    if mean[i] > 0:
        right = t[i] > 0.6 * t.max()
        axes.plot(time_factor * t[i], factor * mean[i], "o", ms=5,
                  color=style.INK, zorder=5)
        axes.annotate("peak of the mean " + style.quantity(mean[i], "N", 3),
                      (time_factor * t[i], factor * mean[i]),
                      xytext=(-8 if right else 8, 2),
                      ha="right" if right else "left", fontsize=9,
                      textcoords="offset points")
    axes.set_xlim(0, time_factor * t.max())
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.set_xlabel(f"Time [{time_unit}]")
    axes.set_ylabel(f"Force on the plate [{unit}]")
    axes.legend(loc="best")
    return figure


def stress_over_strain(run):
    """Nominal stress against strain: stiffness, peak, residual strength and
    what was prescribed."""
    strain, stress = run.column("nominal_strain"), run.column("nominal_stress")
    if strain is None or stress is None or len(strain) < 2:
        return None
    entry = run.results().get("compressive_strength", {})
    reference = entry.get("reference")
    top = max(np.max(np.abs(stress)), reference or 0.0)
    factor, unit = style.prefix_of(top, "Pa")
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    axes.plot(100 * strain, factor * stress, color=style.BLUE)
    mark_stiffness(axes, run, strain, stress, factor)
    mark_peak(axes, run, strain, stress, factor)
    mark_residual(axes, run, strain, factor)
    axes.set_xlim(0, 100 * np.max(strain))
    axes.set_ylim(min(0.0, factor * np.min(stress)), 1.14 * factor * top)
    if reference:
        axes.axhline(factor * reference, color=style.RED, ls=(0, (5, 3)),
                     lw=1.2)
        axes.annotate("prescribed strength "
                      + style.quantity(reference, "Pa", 4),
                      (0, factor * reference), xycoords=("axes fraction",
                                                         "data"),
                      xytext=(3, 4), textcoords="offset points", ha="left",
                      fontsize=9, color=style.RED)
    axes.set_xlabel("Nominal strain (closure over height) [%]")
    axes.set_ylabel(f"Nominal stress [{unit}]")
    return figure


def mark_stiffness(axes, run, strain, stress, factor):
    """The line of the measured stiffness through the middle of the range in
    which it was measured, up to the peak's height."""
    stiffness = run.value("nominal_stiffness")
    peak = int(np.argmax(stress))
    if not stiffness or not stress[peak] > 0:
        return
    rise = np.arange(peak + 1)
    middle = rise[(stress[rise] >= 0.2 * stress[peak])
                  & (stress[rise] <= 0.6 * stress[peak])]
    if not len(middle):
        return
    start = (strain[middle].mean() - stress[middle].mean() / stiffness)
    end = start + stress[peak] / stiffness
    axes.plot([100 * start, 100 * end], [0, factor * stress[peak]],
              color=style.GREEN, lw=1.2, ls=(0, (2, 2)),
              label="stiffness " + style.quantity(stiffness, "Pa", 3))


def mark_peak(axes, run, strain, stress, factor):
    """The peak, and where the force had fallen to half of it."""
    peak = int(np.argmax(stress))
    if run.value("failed_share") is None or not stress[peak] > 0:
        return
    axes.plot(100 * strain[peak], factor * stress[peak], "o", ms=5,
              color=style.INK, zorder=5,
              label="peak " + style.quantity(float(stress[peak]), "Pa", 3)
              + " at " + style.percent(float(strain[peak])))
    drop = run.value("strain_from_peak_to_half")
    if drop is not None:
        axes.plot(100 * (run.value("strain_at_peak", strain[peak]) + drop),
                  0.5 * factor * stress[peak], "v", ms=5, color=style.INK,
                  zorder=5, label="fallen to half")


def mark_residual(axes, run, strain, factor):
    """The residual strength over the part of the stroke that it is of."""
    residual, drop = (run.value("residual_strength"),
                      run.value("strain_from_peak_to_half"))
    at_peak = run.value("strain_at_peak")
    if None not in (residual, drop, at_peak):
        begin = 0.5 * (at_peak + drop + strain[-1])
        axes.plot([100 * begin, 100 * strain[-1]], 2 * [factor * residual],
                  color=style.ORANGE, lw=2.0,
                  label="residual " + style.quantity(residual, "Pa", 3))
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best", fontsize=8.5)


def energy_ledger(run):
    """Stored and dissipated energy stacked under the work of the plates."""
    t = run.column("time")
    if t is None or len(t) < 2:
        return None
    terms = [(run.column(n), label, colour)
             for n, label, colour in STORED + DISSIPATED
             if run.column(n) is not None
             and np.max(np.abs(run.column(n))) > 0]
    if not terms:
        return None
    work, error = run.column("external_work"), run.column("energy_error")
    top = np.max(np.sum([np.abs(y) for y, _, _ in terms], axis=0))
    factor, unit = style.prefix_of(top, "J")
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    rows = 1 if error is None else 2
    figure, grid = plt.subplots(
        rows, 1, sharex=True, squeeze=False, layout="constrained",
        figsize=(9.6, 4.8 if rows == 2 else 3.8),
        gridspec_kw={"height_ratios": [3.4, 1][:rows]})
    axes = grid[0][0]
    # A small term may be negative (round-off): stacks need what is positive.
    axes.stackplot(time_factor * t,
                   [factor * np.maximum(y, 0.0) for y, _, _ in terms],
                   labels=[label for _, label, _ in terms],
                   colors=[colour for _, _, colour in terms], lw=0)
    if work is not None:
        axes.plot(time_factor * t, factor * work, color=style.INK, lw=1.4,
                  label="external work")
    axes.set_xlim(0, time_factor * t.max())
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"Energy [{unit}]")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], loc="upper left",
                bbox_to_anchor=(1.01, 1.02), borderaxespad=0)
    if error is not None:
        below = grid[1][0]
        below.plot(time_factor * t, 100 * error, color=style.INK, lw=1.2)
        below.set_ylim(bottom=0)
        below.set_ylabel("Closing\nerror [%]")
    grid[-1][0].set_xlabel(f"Time [{time_unit}]")
    return figure


def fragment_sizes(run):
    """The fragments' shares of the food, the largest first, with their sum."""
    share = run.fragments.get("mass_share")
    if share is None or len(share) == 0:
        return None
    share = np.sort(share)[::-1]
    # Beyond some tens the bars say nothing more; the rest is in the sum.
    shown = min(len(share), 40)
    rank = np.arange(1, shown + 1)
    count = int(run.value("fragment_count", len(share)))
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    axes.bar(rank, 100 * share[:shown], width=0.82,
             color=[style.FRAGMENTS[k % len(style.FRAGMENTS)]
                    if k < count else style.CRUMB for k in range(shown)])
    axes.set_xlabel("Fragment, the largest first")
    axes.set_ylabel("Share of the food [%]")
    axes.set_xlim(0.3, shown + 0.7)
    axes.xaxis.set_major_locator(plt.MaxNLocator(integer=True, min_n_ticks=1))
    axes.grid(axis="x", visible=False)
    total = axes.twinx()
    total.plot(rank, 100 * np.cumsum(share)[:shown], color=style.INK,
               marker="o", ms=3, lw=1.2)
    total.set_ylim(0, 105)
    total.set_ylabel("Together [%]")
    total.spines["right"].set_visible(True)
    total.grid(False)
    return figure


def fragment_distribution(run):
    """The share of the food in pieces below a size, by diameters of circles
    of equal area; what has failed altogether has none."""
    share, area = (run.fragments.get(name) for name in ("mass_share", "area"))
    if share is None or area is None or len(share) < 2:
        return None
    order = np.argsort(area)
    diameter = np.sqrt(4.0 * area[order] / np.pi)
    dust = max(0.0, 1.0 - float(np.sum(share)))
    below = dust + np.cumsum(share[order])
    factor, unit = style.prefix_of(1e-3 * diameter.max(), "m")
    diameter = 1e-3 * factor * diameter
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    left = 0.6 * diameter[0]
    axes.step(np.concatenate([[left], diameter, [1.3 * diameter[-1]]]),
              100 * np.concatenate([[dust], below, [below[-1]]]),
              where="post", color=style.BLUE)
    axes.fill_between([left, 1.3 * diameter[-1]], 100 * dust,
                      color=style.DUST, lw=0, alpha=0.6)
    if dust > 0.02:
        axes.annotate("dust", (left, 100 * dust), xytext=(4, -11),
                      textcoords="offset points", fontsize=9)
    median = run.value("fragment_median_size")
    if median:
        axes.plot(factor * median, 50, "o", ms=5, color=style.INK, zorder=5)
        axes.annotate("median " + style.quantity(median, "m", 3),
                      (factor * median, 50), xytext=(-6, 5), ha="right",
                      textcoords="offset points", fontsize=9)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(left, 1.3 * diameter[-1])
    axes.set_ylim(0, 102)
    axes.set_xlabel(f"Diameter of a piece (circle of equal area) [{unit}]")
    axes.set_ylabel("Share of the food in smaller pieces [%]")
    return figure


def failed_share(run):
    """The share of the food that has failed, over the closure."""
    strain, failed = run.column("nominal_strain"), run.column("failed_share")
    if strain is None or failed is None or np.max(failed, initial=0) <= 0:
        return None
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    axes.fill_between(100 * strain, 100 * failed, color=style.DUST, lw=0)
    axes.plot(100 * strain, 100 * failed, color=style.INK)
    axes.set_xlim(0, 100 * np.max(strain))
    axes.set_ylim(bottom=0)
    axes.set_xlabel("Nominal strain (closure over height) [%]")
    axes.set_ylabel("Failed share of the food [%]")
    return figure
