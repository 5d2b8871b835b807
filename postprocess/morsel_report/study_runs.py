"""Figures from what the runs of a study left: curves of their histories, and
pictures of their own reports side by side."""
import re
import struct

import matplotlib.pyplot as plt
import numpy as np

from . import page, style
from .reader import NoRun, Run, read_table
from .study_data import (COLOURS, axis_label, capital, in_figure, in_page,
                         name_among)

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


def note_missing(study, entry, without, runs):
    """Notes which runs left no such columns: without is {what: runs}."""
    together = {}
    for what, those in without.items():
        together.setdefault(tuple(map(id, those)), (those, []))[1].append(what)
    for those, what in together.values():
        names = [name_among(study, r, runs) for r in those[:3]]
        study.notes.append(
            f"Figure '{entry['name']}': {len(those)} of {len(runs)} runs left "
            f"no {', '.join(what)} (" + "; ".join(names)
            + ("; …" if len(those) > 3 else "") + ").")


def read_curves(study, entry, runs):
    """[(run, x, [y of each head])] of the runs that have the columns."""
    heads = heads_of(entry["x"])[:1] + heads_of(entry["y"])
    if len(heads) < 2:
        raise ValueError("x and y must name columns of history.csv")
    curves, without = [], {}
    for run in runs:
        history, units = read_table(
            study.folder / run["folder"] / "history.csv")
        columns = [history.get(name) if unit in (None, units.get(name))
                   else None for name, unit in heads]
        for (name, unit), column in zip(heads, columns):
            if column is None:
                what = (f"column '{name}{f' [{unit}]' if unit else ''}'"
                        if history else "history.csv")
                members = without.setdefault(what, [])
                members += [run] if run not in members else []
        if columns[0] is not None and any(c is not None for c in columns[1:]):
            curves.append((run, columns[0], columns[1:]))
    note_missing(study, entry, without, runs)
    return curves, heads[0], heads[1:]


def name_of(names):
    """What columns have in common: the words that all of them hold."""
    words = [n.split("_") for n in names]
    return " ".join(w for w in words[0] if all(w in o for o in words[1:]))


def scale_of(names, unit, arrays):
    """(factor, label) for the values of columns."""
    label = capital(name_of(names) or "Value")
    values = np.abs(np.concatenate(arrays))
    top = float(np.max(values[np.isfinite(values)], initial=0.0))
    if all(style.is_share("_" + n, unit or "1") for n in names):
        return 100.0, axis_label(label, "%")
    factor, prefixed = style.prefix_of(top, unit or "1")
    return factor, axis_label(label, prefixed)


class Looks:
    """Colours by setting; dashes by column or, with one on axes, by series."""

    def __init__(self, study, runs, columns):
        self.columns = columns
        series = list(dict.fromkeys(r["series"] for r in runs))
        names = {id(r): name_among(study, r, runs, draws=False) for r in runs}
        settings = {id(r): name_among(
            study, r, [o for o in runs if o["series"] == r["series"]],
            draws=False) for r in runs}
        titles = {s: study.title_of(s) for s in series}
        # A setting that only bears its series' title is no setting.
        crossed = (columns == 1 and 1 < len(series) <= len(DASHES)
                   and len(set(settings.values())) < len(set(names.values()))
                   and not set(settings.values()) & set(titles.values()))
        self.names = settings if crossed else names
        self.dashes = (dict(zip(series, DASHES)) if crossed
                       else dict.fromkeys(series, "-"))
        self.series = titles if crossed else {}
        self.colours = colours_of(list(dict.fromkeys(self.names.values())))

    def of(self, run, column):
        """How a run's column is drawn."""
        return {"color": self.colours[self.names[id(run)]],
                "ls": DASHES[column % len(DASHES)] if self.columns > 1
                else self.dashes[run["series"]]}

    def handles(self):
        """The legend: settings, then series."""
        return ([plt.Line2D([], [], color=c, lw=1.6, label=in_figure(n))
                 for n, c in self.colours.items()]
                + [plt.Line2D([], [], color=style.INK, lw=1.4,
                              ls=self.dashes[s], label=in_figure(t))
                   for s, t in self.series.items()])


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
    units = list(dict.fromkeys(unit for _, unit in y_heads))
    together = {unit: [i for i, head in enumerate(y_heads) if head[1] == unit]
                for unit in units}
    looks = Looks(study, [c[0] for c in curves],
                  max(map(len, together.values())))
    handles = looks.handles()
    texts = [h.get_label() for h in handles]
    columns = max(1, min(5, len(texts), 105 // (max(map(len, texts)) + 7)))
    figure, grid = plt.subplots(
        len(units), 1, squeeze=False, sharex=True, layout="constrained",
        figsize=(7.4, 1.1 + 3.2 * len(units) + 0.26 * len(texts) / columns))
    fx, label = scale_of([x_head[0]], x_head[1], [x for _, x, _ in curves])
    grid[-1][0].set_xlabel(label)
    for axes, unit in zip(grid[:, 0], units):
        draw_curves(axes, curves, together[unit], y_heads, fx, looks)
    if len(texts) > 1:
        style.legend_above(figure, handles, texts, columns)
    return figure


def draw_curves(axes, curves, members, heads, fx, looks):
    """The columns that share a unit."""
    arrays = [ys[i] for _, _, ys in curves for i in members
              if ys[i] is not None]
    if not arrays:
        return
    fy, label = scale_of([heads[i][0] for i in members], heads[members[0]][1],
                         arrays)
    axes.set_ylabel(label)
    width = 0.9 if len(curves) > len(set(looks.names.values())) else 1.4
    for run, x, ys in curves:
        for j, i in enumerate(members):
            if ys[i] is not None:
                axes.plot(fx * x, fy * ys[i], lw=width, **looks.of(run, j))
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


def is_flat(png):
    """Whether a picture is much wider than high, by its header."""
    width, height = struct.unpack(">II", png[16:24])
    return height < 0.6 * width


def grid_of(pictures):
    """Pictures side by side, each with its label; HTML. Few wide and flat
    ones stand below each other, where they are legible."""
    figures = [page.embedded(png, in_page(capital(label)), label)
               for label, png, _ in pictures]
    flat = any(wide and is_flat(png) for _, png, wide in pictures)
    if len(figures) < 2 or (flat and len(figures) < 4):
        return "".join(figures)
    return f'<div class="pair">{"".join(figures)}</div>'
