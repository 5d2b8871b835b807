"""Tornado tables and figures: what changes when one entry does."""
import html

import matplotlib.pyplot as plt

from . import style
from .study_data import in_figure, in_page
from .study_tables import table

SIDES = {"low": style.SKY, "high": style.ORANGE}


def entry_of(study, change):
    """What is varied in a change."""
    return next(s for s in study.data["sensitivities"]
                if s["name"] == change["sensitivity"])


def groups_of(study, quantity):
    """{(series, setting): changes, the largest first} of a quantity."""
    groups = {}
    for change in study.data["sensitivity_changes"]:
        if change["quantity"] == quantity:
            key = change["series"], tuple(sorted(change["at"].items()))
            groups.setdefault(key, []).append(change)
    return {key: sorted(changes, key=lambda c: -c["size"])
            for key, changes in groups.items()}


def title_of(study, key):
    """"Tennessee marble, n = 36" of a group; empty for the only one."""
    series, setting = key
    parts = [study.title_of(series)] if len(study.series) > 1 else []
    return ", ".join(parts + [f"{a} = {v}" for a, v in setting])


def value_text(entry, change, side):
    """"×0.9", or the value itself, of one end."""
    if change[side] is None:
        return "–"
    return (f"×{entry[side]:g}" if entry.get("relative")
            else style.plain(change[side]["value"]))


def end_text(end):
    """"+1.2 ± 0.3 %" of one end of a variation."""
    if end is None:
        return "–"
    error = end.get("standard_error")
    change = f"{100 * end['change']:+.2g}" if end["change"] else "0"
    return (change.replace("-", "−")
            + (f" ±\u202f{100 * error:.1g}" if error else "") + "\u202f%")


def tornado_table(study, quantity):
    """The changes of a quantity, a table for each group; HTML."""
    parts = []
    for key, changes in groups_of(study, quantity).items():
        rows = []
        for change in changes:
            entry = entry_of(study, change)
            label = in_page(entry["label"])
            bound = entry.get("bound")
            verdict = "–" if bound is None else (
                "<b>beyond</b>" if change["size"] > bound else "within")
            row = [label if bound is None else f"<i>{label}</i>"]
            for side, end in ((s, change[s]) for s in SIDES):
                row += [value_text(entry, change, side), end_text(end)]
            rows.append(row + [verdict])
        bounds = [e["bound"] for e in study.data["sensitivities"]
                  if e.get("bound") is not None]
        limit = f" ({100 * bounds[0]:g}\u202f%)" if bounds else ""
        title = title_of(study, key)
        parts.append((f"<p><b>{html.escape(title)}</b></p>" if title else "")
                     + table(["Entry", "Low", "Change", "High", "Change",
                              f"Bound{limit}"], rows, (0, 5)))
    return "".join(parts)


def draw_group(axes, study, changes):
    """Bars from the base, the largest on top; numerical entries hatched."""
    for i, change in enumerate(changes):
        entry = entry_of(study, change)
        for side, colour in SIDES.items():
            end = change[side]
            if end is None:
                continue
            # Two ends on the same side share the height.
            other = change["high" if side == "low" else "low"]
            shared = other and other["change"] * end["change"] > 0
            shift = 0 if not shared else (-0.18 if side == "low" else 0.18)
            axes.barh(i + shift, 100 * end["change"],
                      height=0.34 if shared else 0.66, color=colour,
                      edgecolor="white", lw=0.3, zorder=2,
                      hatch="////" if entry["numerical"] else None,
                      xerr=100 * (end.get("standard_error") or 0) or None,
                      error_kw={"elinewidth": 0.9, "capsize": 2, "zorder": 4})
    axes.set_yticks(range(len(changes)), [
        ends_text(entry_of(study, c), c) for c in changes])
    axes.set_ylim(len(changes) - 0.4, -0.6)
    axes.axvline(0, color=style.INK, lw=0.9, zorder=3)
    axes.grid(axis="y", visible=False)


def ends_text(entry, change):
    """"Poisson's ratio (0.1, 0.3)": what is varied, and its values."""
    ends = ", ".join(value_text(entry, change, side) for side in SIDES)
    return f"{in_figure(entry['label'])} ({ends})"


def tornado(study, quantity):
    """A tornado of each group below each other, over one axis."""
    groups = groups_of(study, quantity)
    if not groups:
        return None
    heights = [len(changes) + 1.2 for changes in groups.values()]
    figure, grid = plt.subplots(
        len(groups), 1, squeeze=False, sharex=True, layout="constrained",
        figsize=(7.4, 0.28 * sum(heights) + 1.0),
        gridspec_kw={"height_ratios": heights})
    bound = next((e["bound"] for e in study.data["sensitivities"]
                  if e.get("bound") is not None), None)
    for axes, (key, changes) in zip(grid[:, 0], groups.items()):
        draw_group(axes, study, changes)
        if bound is not None:
            axes.axvspan(-100 * bound, 100 * bound, color=style.RULE,
                         alpha=0.5, lw=0, zorder=0)
        axes.set_title(title_of(study, key))
    grid[-1][0].set_xlabel(
        f"Change of the {in_figure(study.label_of(quantity))} [%]")
    handles = [plt.Rectangle((0, 0), 1, 1, color=c) for c in SIDES.values()]
    names = ["low value", "high value"]
    if bound is not None:
        handles += [plt.Rectangle((0, 0), 1, 1, fc=style.QUIET, ec="white",
                                  hatch="////"),
                    plt.Rectangle((0, 0), 1, 1, color=style.RULE, alpha=0.5)]
        names += ["coefficient of the method",
                  f"its bound, {100 * bound:g}\u202f%"]
    style.legend_above(figure, handles, names, 4)
    return figure


def tornado_caption(study, quantity):
    """What the figure shows."""
    changes = [c for c in study.data["sensitivity_changes"]
               if c["quantity"] == quantity]
    counts = [c[s]["count"] for c in changes for s in SIDES if c[s]]
    text = "One entry varied at a time, all else as in the base run."
    if counts and max(counts) > 1:
        text += (f" Means over {max(counts)} draws, each compared with the "
                 "base run of the same draw, with the standard error of the "
                 "mean difference.")
    if any(c.get("beyond_bound") for c in changes):
        names = dict.fromkeys(entry_of(study, c)["label"] for c in changes
                              if c.get("beyond_bound"))
        text += f" Beyond the bound of the method: {', '.join(names)}."
    return text
