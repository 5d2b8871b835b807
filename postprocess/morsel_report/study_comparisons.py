"""Figures of a study over two axes, and of runs side by side."""
import math

import matplotlib.pyplot as plt
import numpy as np

from . import kernels, style
from .study_data import (COLOURS, axis_label, free_axes, groups_of, in_figure,
                         is_wide, leading_axes, look, name_among, plain_ticks,
                         runs_with)

# More settings than these are left to the table of means.
MOST_ROWS = 40


def over_two_axes(study, quantity):
    """The quantity over two axes, as a table in colours; the error where
    there is a truth."""
    runs = runs_with(study, quantity)
    axes = free_axes(study, runs)
    if len(axes) != 2 or kernels.is_stability_study(study):
        return None
    others = [n for n in leading_axes(study) if n not in axes]
    groups = [(series["title"], key, members) for series in study.series
              for key, members in groups_of(
                  [r for r in study.of_series(series["name"]) if r in runs],
                  others).items()]
    errors = study.has_errors(quantity)
    unit = study.quantities[quantity]["unit"]

    def number_of(run):
        entry = run["quantities"][quantity]
        return 100 * entry["error"] if errors else entry["value"]

    top = max(abs(number_of(r)) for r in runs)
    factor, prefixed = (1.0, "%") if errors else style.prefix_of(top, unit)
    signed = min(number_of(r) for r in runs) < -0.05 * top
    columns = min(3, len(groups))
    x, y = ([sorted({r["axes"][n] for r in runs}) for n in axes])
    figure, grid = plt.subplots(
        math.ceil(len(groups) / columns), columns, squeeze=False,
        sharex=True, sharey=True, layout="constrained",
        figsize=(max(6.4, columns * (0.62 * len(x) + 0.6) + 1.6),
                 math.ceil(len(groups) / columns) * (0.42 * len(y) + 1.3)))
    for axes_, (title, key, members) in zip(grid.flat, groups):
        table_ = np.full((len(y), len(x)), np.nan)
        for place, draws in groups_of(members, axes).items():
            place = dict(place)
            table_[y.index(place[axes[1]]), x.index(place[axes[0]])] = (
                factor * np.mean([number_of(r) for r in draws]))
        shown = axes_.imshow(
            table_, origin="lower", aspect="auto",
            cmap="RdBu_r" if signed else "YlOrRd",
            vmin=-factor * top if signed else 0, vmax=factor * top)
        axes_.grid(False)
        for i, j in np.argwhere(np.isfinite(table_)):
            axes_.text(j, i, style.digits(table_[i, j], 3), ha="center",
                       va="center", fontsize=8,
                       color="white" if abs(table_[i, j]) > 0.6 * factor * top
                       else style.INK)
        axes_.set_xticks(range(len(x)), [f"{v:g}" for v in x])
        axes_.set_yticks(range(len(y)), [f"{v:g}" for v in y])
        parts = [title] if len(study.series) > 1 else []
        axes_.set_title(", ".join(
            parts + [study.name_of(a, members[0]) for a, _ in key]))
    for axes_ in grid[-1]:
        axes_.set_xlabel(axis_label(study.axes[axes[0]]["label"],
                                    study.axes[axes[0]]["unit"]))
    for axes_ in grid[:, 0]:
        axes_.set_ylabel(axis_label(study.axes[axes[1]]["label"],
                                    study.axes[axes[1]]["unit"]))
    label = in_figure(study.quantities[quantity]["label"])
    figure.colorbar(shown, ax=grid, label=axis_label(
        f"Error of {label}" if errors else label, prefixed))
    return figure


def make_room(axes, inches=0.6):
    """Room for numbers beside the first and the last point."""
    axes.figure.canvas.draw()
    width = axes.get_window_extent().width / axes.figure.dpi
    axes.margins(x=inches / max(width - 2 * inches, inches))


def side_by_side(study, quantity):
    """Series, and what texts tell apart, below each other: errors or values."""
    runs = runs_with(study, quantity)
    if (len(runs) < 3 or study.random_axes() or study.converges(quantity)
            or free_axes(study, runs)):
        return None
    errors = study.has_errors(quantity)
    if errors:
        runs = [r for r in runs
                if r["quantities"][quantity]["error"] is not None]
        values = [100 * r["quantities"][quantity]["error"] for r in runs]
        unit = "%"
    else:
        values = [r["quantities"][quantity]["value"] for r in runs]
        factor, unit = style.prefix_of(
            max(map(abs, values)), study.quantities[quantity]["unit"])
        values = [factor * v for v in values]
    order = {s["name"]: k for k, s in enumerate(study.series)}
    figure, axes = plt.subplots(figsize=(7.4, 0.3 * len(runs) + 1.1),
                                layout="constrained")
    largest = max(map(abs, values))
    for i, (run, value) in enumerate(zip(runs, values)):
        colour = COLOURS[order[run["series"]] % len(COLOURS)]
        axes.plot([0, value], [i, i], color=colour, lw=1.2, alpha=0.5)
        axes.plot(value, i, "o", color=colour, ms=6)
        # Next to zero there is room on the right alone.
        side = -1 if value < -0.02 * largest else 1
        axes.annotate(style.digits(value, 3), (value, i), fontsize=8,
                      textcoords="offset points", va="center",
                      xytext=(8 * side, 0),
                      ha="left" if side > 0 else "right")
    axes.set_yticks(range(len(runs)),
                    [name_among(study, r, runs) for r in runs])
    axes.set_ylim(len(runs) - 0.5, -0.5)
    axes.axvline(0, color=style.INK, lw=0.8)
    make_room(axes)
    axes.grid(axis="y", visible=False)
    label = in_figure(study.quantities[quantity]["label"])
    axes.set_xlabel(axis_label(f"Error of {label}" if errors else label, unit))
    return figure


def settings_of(study, runs):
    """The draws of each setting, {(series, what varies in it): runs}."""
    settings = {}
    for series in study.series:
        own = [r for r in runs if r["series"] == series["name"]]
        for r in own:
            key = series["name"], name_among(study, r, own, draws=False)
            settings.setdefault(key, []).append(r)
    return settings


def is_over_resolution(study, quantity):
    """Whether draws differ in resolution alone, apart from their series."""
    runs = runs_with(study, quantity)
    leading = [n for n in leading_axes(study)
               if len({r["axes"].get(n) for r in runs} - {None}) > 1]
    return (bool(study.random_axes()) and bool(leading)
            and all(study.refines(n) for n in leading))


def draws_over_resolution(study, quantity):
    """Draws, their means and standard deviations over the resolution."""
    if not is_over_resolution(study, quantity):
        return None
    runs = [r for r in runs_with(study, quantity) if r["resolution"]]
    factor, unit = style.prefix_of(
        max(abs(r["quantities"][quantity]["value"]) for r in runs),
        study.unit_of(quantity))
    figure, axes = plt.subplots(figsize=(7.4, 4.4), layout="constrained")
    for k, series in enumerate(study.series):
        own = [r for r in runs if r["series"] == series["name"]]
        # Beside each other, so that bars of one resolution stay apart.
        shift = 1.0 + 0.02 * (k - 0.5 * (len(study.series) - 1))
        steps = {}
        for r in own:
            steps.setdefault(float(f"{r['resolution']:.2g}"), []).append(r)
        x, means, spreads = [], [], []
        for _, members in sorted(steps.items()):
            values = np.array([factor * r["quantities"][quantity]["value"]
                               for r in members])
            place = shift * np.mean([r["resolution"] for r in members])
            axes.plot(np.full(len(values), place), values, ls="none", ms=3,
                      alpha=0.4, mew=0, **look(k))
            x.append(place)
            means.append(values.mean())
            spreads.append(values.std(ddof=1) if len(values) > 1 else 0.0)
        axes.errorbar(x, means, yerr=spreads, lw=1.2, ms=6, capsize=3,
                      elinewidth=1.0, label=series["title"], **look(k))
    truths = {r["quantities"][quantity]["truth"] for r in runs}
    if len(truths) == 1 and None not in truths:
        axes.axhline(factor * truths.pop(), color=style.INK, lw=1.0, ls="--",
                     zorder=1, label="truth")
    axes.set_xscale("log")
    plain_ticks(axes.xaxis, [r["resolution"] for r in runs])
    axes.set_xlabel(axis_label(study.data["resolution"]["label"], "1"))
    axes.set_ylabel(axis_label(in_figure(study.label_of(quantity)), unit))
    handles, labels = axes.get_legend_handles_labels()
    style.legend_above(figure, handles, labels, 2)
    return figure


def has_settings(study, quantity):
    """Whether there are draws of several settings that fit below each other,
    and no axis of numbers to show them over."""
    runs = runs_with(study, quantity)
    settings = settings_of(study, runs)
    names = {name for _, name in settings}
    return (bool(study.random_axes()) and not free_axes(study, runs)
            and not is_over_resolution(study, quantity)
            and len({series for series, _ in settings}) < len(settings)
            and len(names) <= MOST_ROWS)


def draws_side_by_side(study, quantity):
    """The draws of each setting below each other, with their means."""
    if not has_settings(study, quantity):
        return None
    runs = runs_with(study, quantity)
    errors = study.has_errors(quantity)
    kind = "error" if errors else "value"
    runs = [r for r in runs if r["quantities"][quantity][kind] is not None]
    settings = settings_of(study, runs)
    factor, unit = (100.0, "%") if errors else style.prefix_of(
        max(abs(r["quantities"][quantity]["value"]) for r in runs),
        study.unit_of(quantity))
    rows = list(dict.fromkeys(name for _, name in settings))
    order = {s["name"]: k for k, s in enumerate(study.series)}
    height = 0.3 + 0.14 * (len(order) - 1)
    figure, axes = plt.subplots(layout="constrained", figsize=(
        7.4, height * len(rows) + 0.9))
    for (series, name), members in settings.items():
        k = order[series]
        colour = COLOURS[k % len(COLOURS)]
        y = rows.index(name) + (k - 0.5 * (len(order) - 1)) * 0.7 / len(order)
        values = np.array([factor * r["quantities"][quantity][kind]
                           for r in members])
        axes.plot(values, np.full(len(values), y), "o", ms=4.5, alpha=0.55,
                  color=colour, mew=0)
        axes.plot(values.mean(), y, "|", ms=11, mew=2, color=colour)
    axes.set_yticks(range(len(rows)), rows)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.grid(axis="y", visible=False)
    everything = factor * np.array([r["quantities"][quantity][kind]
                                    for r in runs])
    if errors:
        axes.axvline(0, color=style.INK, lw=0.8, zorder=1)
    elif is_wide(everything):
        axes.set_xscale("log")
        plain_ticks(axes.xaxis, everything)
    label = in_figure(study.label_of(quantity))
    axes.set_xlabel(axis_label(f"Error of {label}" if errors else label, unit))
    if len(order) > 1:
        style.legend_above(figure, [
            plt.Line2D([], [], color=COLOURS[k % len(COLOURS)], marker="o",
                       ls="none") for k in order.values()],
            [study.title_of(s) for s in order], min(4, len(order)))
    return figure
