"""Figures that a study calls for by what varies in it."""
import math

import matplotlib.pyplot as plt
import numpy as np

from . import kernels, style
from .study_comparisons import (draws_over_resolution, draws_side_by_side,
                                has_settings, is_over_resolution,
                                over_two_axes, side_by_side)
from .study_data import (COLOURS, axis_label, free_axes, groups_of, in_figure,
                         leading_axes, look, percent_ticks, plain_ticks,
                         runs_with)

COSTS = [("time", "Time", "s"), ("unknowns", "Unknowns", "1"),
         ("memory", "Peak memory", "B")]


def rate_text(fit):
    """"rate 1.98 ± 0.05" of a fit."""
    if fit["low"] is None:
        return f"rate {fit['rate']:.2f}"
    half = (fit["high"] - fit["low"]) / 2
    return f"rate {fit['rate']:.2f} ± {half:.2f}"


def convergence(study, quantity):
    """Error against resolution, with the fitted rates."""
    runs = [r for r in study.runs if r["resolution"]
            and study.error(r, quantity) is not None]
    if not study.converges(quantity):
        return None
    fits = [f for f in study.data["rates"] if f["quantity"] == quantity]
    figure, axes = plt.subplots(figsize=(7.4, 4.9), layout="constrained")
    for k, series in enumerate(study.series):
        own = [r for r in runs if r["series"] == series["name"]]
        fits_here = [f for f in fits if f["series"] == series["name"]]
        for i, fit in enumerate(fits_here or [None]):
            members = [r for r in own if fit is None or all(
                str(r["axes"].get(a)) == v or same(r["axes"].get(a), v)
                for a, v in fit["at"].items())]
            members.sort(key=lambda r: r["resolution"])
            if not members:
                continue
            x = np.array([r["resolution"] for r in members])
            y = np.array([study.error(r, quantity) for r in members])
            label = series["title"]
            if fit and fit["at"]:
                label += ", " + ", ".join(f"{a} {v}"
                                          for a, v in fit["at"].items())
            if fit:
                label += ": " + rate_text(fit)
            axes.plot(x, y, ls="-", lw=0.8, alpha=1 - 0.12 * i, ms=5.5,
                      label=label, **look(k))
            if fit:
                ends = np.array([x.min(), x.max()])
                axes.plot(ends, fit["constant"] * ends ** -fit["rate"],
                          color=COLOURS[k % len(COLOURS)], ls=(0, (5, 3)),
                          lw=1.2)
    axes.set_xscale("log")
    axes.set_yscale("log")
    values = [r["resolution"] for r in runs]
    plain_ticks(axes.xaxis, values)
    percent_ticks(axes)
    floor = study.quantities[quantity]["truth_accuracy"]
    if floor > 0:
        bottom = min(axes.get_ylim()[0], 0.5 * floor)
        axes.axhspan(bottom, floor, color="#eeeeee", zorder=0)
        axes.set_ylim(bottom=bottom)
    label = study.data["resolution"]["label"]
    axes.set_xlabel(axis_label(label, "1"))
    axes.set_ylabel("Error of " + in_figure(study.label_of(quantity)))
    handles, labels = axes.get_legend_handles_labels()
    style.legend_above(figure, handles, labels,
                       2 if max(map(len, labels)) < 48 else 1)
    return figure


def same(value, text):
    """Whether a text is the number of this value."""
    try:
        return abs(float(text) - float(value)) <= 1e-9 * max(1, abs(
            float(value)))
    except (TypeError, ValueError):
        return False


def work_precision(study, quantity):
    """Error against time, unknowns and memory, with the Pareto fronts."""
    runs = [r for r in study.runs if study.error(r, quantity) is not None]
    shown = [c for c in COSTS if len({r[c[0]] for r in runs if r[c[0]]}) > 1]
    if len(runs) < 3 or not shown or study.random_axes() or not (
            study.data["timing"] or study.converges(quantity)):
        return None
    figure, grid = plt.subplots(1, len(shown), sharey=True, squeeze=False,
                                figsize=(4.1 * len(shown), 4.4),
                                layout="constrained")
    for axes, (cost, label, unit) in zip(grid[0], shown):
        known = [r for r in runs if r[cost]]
        factor, prefixed = style.prefix_of(
            float(np.median([r[cost] for r in known])), unit)
        if cost == "time":
            factor, prefixed = 1.0, "s"
        draw_front(axes, study, quantity, cost, factor)
        for k, series in enumerate(study.series):
            own = sorted((r for r in known if r["series"] == series["name"]),
                         key=lambda r: r[cost])
            x = np.array([factor * r[cost] for r in own])
            y = [study.error(r, quantity) for r in own]
            if cost == "time" and study.data["timing"]:
                spread = np.array([[factor * (r["time"] - r["time_low"]),
                                    factor * (r["time_high"] - r["time"])]
                                   for r in own]).reshape(-1, 2).T
                axes.errorbar(x, y, xerr=spread, fmt="none", lw=0.8,
                              ecolor=COLOURS[k % len(COLOURS)], alpha=0.6)
            axes.plot(x, y, lw=1.1, ms=5.5, label=series["title"], **look(k))
        axes.set_xscale("log")
        axes.set_yscale("log")
        plain_ticks(axes.xaxis, [factor * r[cost] for r in known])
        axes.set_xlabel(axis_label(label, prefixed))
    percent_ticks(grid[0][0])
    grid[0][0].set_ylabel("Error of " + in_figure(study.label_of(quantity)))
    handles, labels = grid[0][0].get_legend_handles_labels()
    columns = min(5, len(labels))
    style.legend_above(figure, handles, labels, columns)
    return figure


def draw_front(axes, study, quantity, cost, factor):
    """The Pareto front as a broad grey line below the runs."""
    for front in study.data["pareto_fronts"]:
        if front["quantity"] == quantity and front["cost"] == cost:
            best = [study.runs[i] for i in front["runs"]]
            axes.plot([factor * r[cost] for r in best],
                      [study.error(r, quantity) for r in best], lw=8,
                      color="#e0d9c3", solid_capstyle="round",
                      solid_joinstyle="round", zorder=1, label="Pareto front")


def over_axis(study, quantity):
    """The quantity over an axis that is no resolution, with its truth."""
    runs = runs_with(study, quantity)
    candidates = free_axes(study, runs)
    if len(candidates) in (0, 2):  # see over_two_axes()
        return None
    others = [n for n in leading_axes(study) if n != candidates[0]]
    return draw_over_axis(study, quantity, candidates[0], others, runs)


def draw_means(axes, x, y, label, k):
    """A line through the points; where draws share an x, through their means,
    with the draws as dots."""
    places = np.unique(x)
    means = np.array([y[x == place].mean() for place in places])
    axes.plot(places, means, lw=1.0, ms=5, label=label, **look(k))
    if len(places) < len(x):
        axes.plot(x, y, ls="none", ms=3, alpha=0.4, mew=0, **look(k))


def draw_over_axis(study, quantity, axis, others, runs):
    """Values with the truth above, errors below."""
    unit = study.quantities[quantity]["unit"]
    values = [r["quantities"][quantity]["value"] for r in runs]
    factor, prefixed = style.prefix_of(max(map(abs, values)), unit)
    errors = study.has_errors(quantity)
    figure, grid = plt.subplots(
        2 if errors else 1, 1, sharex=True, squeeze=False,
        figsize=(7.4, 6.2 if errors else 4.4), layout="constrained",
        gridspec_kw={"height_ratios": [2, 1.1] if errors else [1]})
    upper = grid[0][0]
    truths, k = {}, -1
    for series in study.series:
        own = [r for r in runs if r["series"] == series["name"]
               and r["axes"].get(axis) is not None]
        for key, members in groups_of(own, others).items():
            k += 1
            members.sort(key=lambda r: r["axes"][axis])
            x = np.array([r["axes"][axis] for r in members])
            y = np.array([factor * r["quantities"][quantity]["value"]
                          for r in members])
            parts = [series["title"]] if len(study.series) > 1 else []
            parts += [study.name_of(a, members[0]) for a, _ in key]
            label = ", ".join(parts) or "computed"
            draw_means(upper, x, y, label, k)
            measured = [r for r in members
                        if study.error(r, quantity) is not None]
            if errors and measured:
                draw_means(
                    grid[1][0],
                    np.array([r["axes"][axis] for r in measured]),
                    np.array([study.error(r, quantity) for r in measured]),
                    "", k)
            for r in members:
                truth = r["quantities"][quantity]["truth"]
                if truth is not None:
                    truths.setdefault(r["axes"][axis], set()).add(truth)
    if truths and all(len(t) == 1 for t in truths.values()):
        x = sorted(truths)
        upper.plot(x, [factor * next(iter(truths[v])) for v in x],
                   color=style.INK, lw=1.0, marker="_", ms=14, label="truth",
                   zorder=1, ls="--" if study.quantities[quantity]["truth"]
                   == "formula" else "none")
    upper.set_ylabel(axis_label(in_figure(
        study.quantities[quantity]["label"]), prefixed))
    upper.legend(loc="best")
    if errors:
        grid[1][0].set_yscale("log")
        percent_ticks(grid[1][0])
        grid[1][0].set_ylabel("Error")
    grid[-1][0].set_xlabel(axis_label(study.axes[axis]["label"],
                                      study.axes[axis]["unit"]))
    return figure


def scatter_of_draws(study, quantity):
    """How the errors, or values, of draws are distributed."""
    errors = study.has_errors(quantity)
    if not study.random_axes() or has_settings(
            study, quantity) or is_over_resolution(study, quantity) or (
            not errors and free_axes(study, runs_with(study, quantity))):
        return None  # see draws_side_by_side() and over_axis()
    samples = []
    for series in study.series:
        if errors:
            own = [r["quantities"][quantity]["error"]
                   for r in study.of_series(series["name"])]
        else:
            own = [r["quantities"][quantity]["value"]
                   for r in study.of_series(series["name"])]
        own = [v for v in own if v is not None]
        if len(own) > 1:
            samples.append((series["title"], np.array(own)))
    if not samples:
        return None
    top = max(float(np.max(np.abs(s))) for _, s in samples)
    power = 0
    if errors:
        # Percent, and below that powers of ten of it.
        power = math.floor(math.log10(100 * top)) if top > 0 else 0
        power = power if power < -1 else 0
        factor, unit = 100.0 * 10.0 ** -power, "%"
        if power:
            unit = f"{style.ten_to(power)} %"
    else:
        factor, unit = style.prefix_of(
            top, study.quantities[quantity]["unit"])
    figure, axes = plt.subplots(figsize=(7.4, 4.2), layout="constrained")
    everything = np.concatenate([s for _, s in samples]) * factor
    bins = np.linspace(everything.min(), everything.max() or 1, 31)
    for k, (title, sample) in enumerate(samples):
        axes.hist(factor * sample, bins=bins, color=COLOURS[k], alpha=0.65,
                  label=f"{title}, {len(sample)} runs")
        axes.axvline(factor * float(np.mean(sample)), color=COLOURS[k],
                     ls="--", lw=1.2)
    if errors:
        axes.axvline(0, color=style.INK, lw=1.0)
    label = in_figure(study.quantities[quantity]["label"])
    axes.set_xlabel(axis_label(f"Error of {label}" if errors else label, unit))
    axes.set_ylabel("Runs")
    axes.yaxis.set_major_locator(plt.MaxNLocator(integer=True))
    axes.legend(loc="best")
    return figure


FIGURES = [
    ("work_precision", work_precision,
     "What accuracy costs: error against time, unknowns and memory. On the "
     "broad line lie the runs that none other beats in both (Pareto front). "
     "Memory starts from what the program with its libraries takes."),
    ("convergence", convergence,
     "Error against resolution, with the fitted rates (95 % confidence). In "
     "the grey band the truth itself is not known."),
    ("over_axis", over_axis, "The result over the axis, beside its truth."),
    ("over_two_axes", over_two_axes,
     "The result over two axes."),
    ("side_by_side", side_by_side, "The runs side by side."),
    ("stability", kernels.stability_map,
     "The rate at which a small disturbance of a stressed lattice grows, over "
     "smoothing ratio and stress: above as runs measured it, below by linear "
     "theory of plane waves. Hatched is what Swegle's condition W'' sigma > 0 "
     "at the nearest neighbours calls unstable."),
    ("draws", scatter_of_draws,
     "How the draws scatter; dashed is the mean."),
    ("draws_over_resolution", draws_over_resolution,
     "The draws over the resolution, with their means and standard "
     "deviations."),
    ("draws_by_setting", draws_side_by_side,
     "The draws of each setting; the bars are their means."),
]
