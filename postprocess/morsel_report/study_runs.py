"""Figures from what the runs of a study left: curves of their histories, and
pictures of their own reports side by side."""
import html
import re

import matplotlib.pyplot as plt
import numpy as np

from . import page, style
from .reader import NoRun, Run, read_table
from .study_data import COLOURS, axis_label, name_among

# More curves than these are told apart by shades of one colour map.
MOST_COLOURS = len(COLOURS)
DASHES = ["-", (0, (5, 2)), ":", (0, (5, 2, 1, 2))]


def heads_of(text):
    """Column heads, "stress [Pa], force [N]", as [(name, unit)]."""
    heads = text if isinstance(text, list) else re.split(
        r",(?![^\[]*\])", str(text or ""))
    found = [re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", h) for h in heads]
    return [(m.group(1), m.group(2)) for m in found if m.group(1)]


def runs_of(study, entry):
    """The runs of a figure that finished; what is missing is noted."""
    runs = [study.runs[i] for i in entry["runs"]]
    done = [r for r in runs if r["status"] == "finished"]
    if len(done) < len(runs):
        study.notes.append(
            f"Figure '{entry['name']}': {len(runs) - len(done)} of its "
            f"{len(runs)} runs have not finished.")
    if not runs:
        study.notes.append(f"Figure '{entry['name']}' is of no run.")
    return done


def columns_of(table, units, heads):
    """The columns of these heads, None for those that are missing."""
    return [table.get(name) if unit is None or units.get(name) == unit
            else None for name, unit in heads]


def read_curves(study, entry, runs):
    """[(run, x, [y of each head])] of the runs that have the columns."""
    x_head, y_heads = heads_of(entry["x"])[:1], heads_of(entry["y"])
    if not x_head or not y_heads:
        raise ValueError("x and y must name columns of history.csv")
    curves, without = [], {}
    for run in runs:
        table, units = read_table(study.folder / run["folder"] / "history.csv")
        columns = columns_of(table, units, x_head + y_heads)
        for (name, unit), column in zip(x_head + y_heads, columns):
            if column is None:
                what = f"the column '{name}{f' [{unit}]' if unit else ''}'"
                what = what if table else "history.csv"
                without.setdefault(what, []).append(run)
        if columns[0] is not None and any(c is not None for c in columns[1:]):
            curves.append((run, columns[0], columns[1:]))
    for what, those in without.items():
        study.notes.append(
            f"Figure '{entry['name']}': {len(those)} of {len(runs)} runs left "
            f"no {what.removeprefix('the ')} ("
            + "; ".join(name_among(study, r, runs) for r in those[:3])
            + ("; …" if len(those) > 3 else "") + ").")
    return curves, x_head[0], y_heads


def scale_of(name, unit, arrays):
    """(factor, label) for the values of a column."""
    label = name.replace("_", " ")
    label = label[:1].upper() + label[1:]
    values = np.abs(np.concatenate(arrays))
    top = float(np.max(values[np.isfinite(values)], initial=0.0))
    if style.is_share("_" + name, unit or "1"):
        return 100.0, axis_label(label, "%")
    factor, prefixed = style.prefix_of(top, unit or "1")
    return factor, axis_label(label, prefixed)


def colours_of(names):
    """A colour for each name."""
    if len(names) <= MOST_COLOURS:
        return dict(zip(names, COLOURS))
    shades = plt.get_cmap("viridis")(np.linspace(0, 0.93, len(names)))
    return dict(zip(names, shades))


def history_figure(study, entry):
    """Curves of the runs' histories; draws of one setting in one colour."""
    runs = runs_of(study, entry)
    curves, x_head, y_heads = read_curves(study, entry, runs)
    if not curves:
        return None
    shown = [c[0] for c in curves]
    names = {id(r): name_among(study, r, shown, draws=False) for r in shown}
    colours = colours_of(list(dict.fromkeys(names.values())))
    units = list(dict.fromkeys(unit for _, unit in y_heads))
    figure, grid = plt.subplots(
        len(units), 1, squeeze=False, sharex=True, layout="constrained",
        figsize=(7.4, 1.3 + 3.3 * len(units)))
    fx, label = scale_of(*x_head, [x for _, x, _ in curves])
    grid[-1][0].set_xlabel(label)
    for axes, unit in zip(grid[:, 0], units):
        members = [i for i, head in enumerate(y_heads) if head[1] == unit]
        draw_curves(axes, curves, members, y_heads, fx, names, colours)
    handles, texts = grid[0][0].get_legend_handles_labels()
    handles = [plt.Line2D([], [], color=colours[t], lw=1.6) for t in texts]
    if len(texts) > 1:
        longest = max(map(len, texts))
        style.legend_above(figure, handles, texts,
                           max(1, min(5, len(texts), int(105 / (longest + 7)))))
    return figure


def draw_curves(axes, curves, members, heads, fx, names, colours):
    """The columns that share a unit."""
    arrays = [ys[i] for _, _, ys in curves for i in members
              if ys[i] is not None]
    if not arrays:
        return
    name = heads[members[0]][0] if len(members) == 1 else ""
    fy, label = scale_of(name, heads[members[0]][1], arrays)
    axes.set_ylabel(label.strip())
    labelled = set()
    many = len(curves) > len(colours)
    for run, x, ys in curves:
        text = names[id(run)]
        for j, i in enumerate(members):
            if ys[i] is not None:
                axes.plot(fx * x, fy * ys[i], color=colours[text],
                          ls=DASHES[j % len(DASHES)],
                          lw=0.9 if many else 1.4, alpha=0.75 if many else 1,
                          label="" if text in labelled else text)
                labelled.add(text)
    axes.margins(x=0.02)
    if len(members) > 1:
        axes.legend(handles=[
            plt.Line2D([], [], color=style.INK, ls=DASHES[j % len(DASHES)],
                       label=heads[i][0].replace("_", " "))
            for j, i in enumerate(members)], loc="best")


def run_pictures(study, entry):
    """[(label, png, whether it is wide)] of a figure of the runs' reports."""
    runs = runs_of(study, entry)
    pictures = []
    for run in runs:
        label = name_among(study, run, runs)
        try:
            png, wide = page.picture_of(Run(study.folder / run["folder"]),
                                        entry["picture"])
            pictures.append((label, png, wide))
        except (NoRun, LookupError) as error:
            study.notes.append(f"Figure '{entry['name']}', {label}: "
                               f"{error.args[0]}")
    return pictures


def grid_of(pictures):
    """Pictures side by side, each with its label; HTML."""
    figures = [page.embedded(png, html.escape(label[:1].upper() + label[1:]),
                             label) for label, png, _ in pictures]
    if len(figures) < 2 or (any(wide for _, _, wide in pictures)
                            and len(figures) < 4):
        return "".join(figures)
    return f'<div class="pair">{"".join(figures)}</div>'
