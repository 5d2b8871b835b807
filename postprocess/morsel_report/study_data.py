"""A study's results, and how its axes and labels are shown."""
import html
import json
import math
import pathlib
import re

import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, NullLocator

from . import style
from .reader import NoRun

COLOURS = [style.BLUE, style.RED, style.GREEN, style.PURPLE, style.ORANGE,
           style.SKY, style.BLACK, "#8c6d31"]
# Values over more decades than this are drawn over logarithms.
WIDEST_LINEAR = 1.2
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]

# What study.json must have, and what the members are that it may have.
NEEDED = {"runs": list, "series": list, "quantities": dict, "axes": dict}
OPTIONAL = {"rates": list, "pareto_fronts": list, "time_to_reach": list,
            "statistics": list, "relations": list, "claims": list,
            "figures": list, "sensitivities": list,
            "sensitivity_changes": list}


def read_document(file):
    """The object that a JSON file holds."""
    try:
        document = json.loads(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise NoRun(f"'{file}' is not readable: {error}.") from error
    if not isinstance(document, dict):
        raise NoRun(f"'{file}' holds no object.")
    return document


def is_readable(member, kind):
    """Whether a member is a list, or an object, of objects."""
    return isinstance(member, kind) and all(
        isinstance(entry, dict)
        for entry in (member.values() if kind is dict else member))


class Study:
    """study.json of one folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.notes = []
        self.data = read_document(self.folder / "study.json")
        for name, kind in NEEDED.items():
            if not is_readable(self.data.get(name), kind):
                raise NoRun(f"'{self.folder}/study.json' is no study's: its "
                            f"'{name}' cannot be read.")
        for name, kind in OPTIONAL.items():
            self._check(name, kind)
        self.data.setdefault("timing", False)
        if not isinstance(self.data.get("resolution"), dict):
            self.data["resolution"] = {"formula": "", "label": "resolution"}
        self.title = self.text("title") or self.text("name") or "A study"
        # Variations stand after the runs that they vary, and show in the
        # tornado alone.
        self.all_runs = self.data["runs"]
        self.runs = [r for r in self.all_runs if not r.get("variation")]
        self.series = self.data["series"]
        self.quantities = self.data["quantities"]
        self.axes = self.data["axes"]

    def _check(self, name, kind):
        """Makes sure that a member is there; what is unreadable is noted."""
        member = self.data.get(name)
        if not is_readable(member, kind):
            if member is not None:
                self.notes.append(f"study.json: '{name}' cannot be read.")
            self.data[name] = kind()

    def attempt(self, what, make, *arguments):
        """What make(*arguments) returns; empty, with a note, where it cannot
        read what it needs."""
        try:
            return make(*arguments)
        except style.BROKEN as error:
            note = f"{what} cannot be shown ({style.problem_of(error)})."
            if note not in self.notes:
                self.notes.append(note)
            return ""

    def text(self, name):
        """A text of study.json; empty where there is none."""
        return str(self.data.get(name) or "")

    def title_of(self, name):
        """The title of a series."""
        return next((s["title"] for s in self.series if s["name"] == name),
                    str(name))

    def label_of(self, quantity):
        """The label of a quantity."""
        return str(self.quantities.get(quantity, {}).get("label") or quantity)

    def unit_of(self, quantity):
        """The unit of a quantity."""
        return self.quantities.get(quantity, {}).get("unit") or "1"

    def drawn(self):
        """The quantities that get figures by themselves."""
        return [q for q, entry in self.quantities.items()
                if entry.get("drawn", True)]

    def of_series(self, name):
        """The finished runs of a series."""
        return [r for r in self.runs
                if r["series"] == name and r["status"] == "finished"]

    def error(self, run, quantity):
        """|error| of a run, not below what the truth is known to; or None."""
        error = run["quantities"][quantity]["error"]
        if error is None:
            return None
        return max(abs(error), self.quantities[quantity]["truth_accuracy"],
                   1e-16)

    def has_errors(self, quantity):
        """Whether any run has an error."""
        return any(r["quantities"][quantity]["error"] is not None
                   for r in self.runs)

    def random_axes(self):
        """The names of the axes whose values are draws."""
        return [n for n, a in self.axes.items()
                if a["kind"] in ("random", "seeds")]

    def refines(self, axis):
        """Whether the resolution goes along with an axis."""
        for series in self.series:
            runs = [r for r in self.of_series(series["name"])
                    if r["resolution"] and axis in r["axes"]]
            others = [n for n in self.axes if n != axis
                      and self.axes[n]["together_with"] != axis]
            for members in groups_of(runs, others).values():
                found = [r["resolution"] for r in members]
                if max(found) > 1.5 * min(found) > 0:
                    return True
        return False

    def converges(self, quantity):
        """Whether there are errors at three resolutions or more."""
        return not self.random_axes() and any(
            f["points"] > 2 for f in self.data["rates"]
            if f["quantity"] == quantity)

    def name_of(self, axis, run):
        """"angle = 30°" of a run."""
        value = run["axes"].get(axis)
        unit = self.axes[axis]["unit"]
        text = (str(value) if isinstance(value, str)
                else style.plain(value) if value is not None else "")
        unit = "" if unit == "1" else "\u202f" + style.pretty_unit(unit)
        return f"{self.axes[axis]['label']} {text}{unit}"


def in_figure(label):
    """A label with its subscript, K_I, as matplotlib sets it."""
    return re.sub(r"\b([A-Za-z])_(\w+)\b", r"$\1_{\\mathrm{\2}}$", label)


def in_page(label):
    """A label with its subscript as HTML."""
    return re.sub(r"\b([A-Za-z])_(\w+)\b", r"\1<sub>\2</sub>",
                  html.escape(label))


def look(k):
    """Colour and marker of the k-th series."""
    return {"color": COLOURS[k % len(COLOURS)],
            "marker": MARKERS[k % len(MARKERS)]}


def capital(label):
    """A label as a title begins; symbols, h/dp, sqrt(E), stay as they are."""
    return (label[:1].upper() + label[1:]
            if re.match(r"[a-z]{3,}(?![a-z(/_])", label) else label)


def axis_label(label, unit):
    """A label with its unit in brackets."""
    unit = style.pretty_unit(unit)
    return capital(label) + (f" [{unit}]" if unit else "")


def percent_ticks(axes):
    """Ticks of a logarithmic axis of errors as percentages."""
    def text(value, _):
        power = math.log10(value) if value > 0 else 0
        if abs(power - round(power)) > 1e-9:
            return ""
        shown = round(power) + 2
        if -3 <= shown <= 3:
            return f"{10.0 ** shown:g}\u202f%"
        return f"{style.ten_to(shown)}\u202f%"

    axis = axes.yaxis
    axis.set_major_formatter(plt.FuncFormatter(text))
    axis.set_minor_formatter(plt.NullFormatter())
    low, high = axis.get_view_interval()
    if high < 30 * low:
        # At least one power of ten on either side has a name.
        axis.set_view_interval(10.0 ** math.floor(math.log10(low)),
                               10.0 ** math.ceil(math.log10(high)), True)


def is_wide(values):
    """Whether values are best drawn over their logarithms."""
    return min(values) > 0 and math.log10(
        max(values) / min(values)) > WIDEST_LINEAR


def plain_ticks(axis, values):
    """Logarithmic ticks in plain numbers; few where there are many decades,
    the values themselves where these are few and near."""
    range_of = max(values) / min(values)
    places = sorted(set(values))
    if 1 < len(places) < 9 and range_of < 12 and all(
            b > 1.12 * a for a, b in zip(places, places[1:])):
        axis.set_major_locator(FixedLocator(places))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(plt.FuncFormatter(
            lambda v, _: f"{v:.3g}" if v < 1000 else style.digits(v, 3)))
        return
    if range_of < 1e4:
        axis.set_major_formatter(plt.FuncFormatter(
            lambda v, _: f"{v:,g}".replace(",", "\u202f")))
    axis.set_minor_formatter(plt.FuncFormatter(
        lambda v, _: f"{v:,g}".replace(",", "\u202f")
        if range_of < 25 and f"{v:.0e}"[0] in "25" else ""))


def groups_of(runs, separated):
    """Runs by the values of some axes, in the order of the study."""
    groups = {}
    for run in runs:
        key = tuple((a, run["axes"][a]) for a in separated if a in run["axes"])
        groups.setdefault(key, []).append(run)
    return groups


def leading_axes(study):
    """The axes that are neither draws nor go along with another one."""
    return [n for n, a in study.axes.items()
            if a["together_with"] not in study.axes
            and n not in study.random_axes()]


def free_axes(study, runs):
    """The axes of three numbers or more that are no resolution."""
    return [n for n in leading_axes(study)
            if study.axes[n]["kind"] != "texts"
            and len({r["axes"].get(n) for r in runs} - {None}) > 2
            and not study.refines(n)]


def name_among(study, run, others, draws=True):
    """What tells a run from others: its series, and the axes that vary in
    it."""
    parts = []
    if len({r["series"] for r in others}) > 1:
        parts.append(study.title_of(run["series"]))
    alike = [r for r in others if r["series"] == run["series"]]
    parts += [study.name_of(a, run) for a in run["axes"]
              if len({r["axes"].get(a) for r in alike}) > 1
              and study.axes[a]["together_with"] not in study.axes
              and (draws or a not in study.random_axes())]
    return ", ".join(parts) or study.title_of(run["series"])


def runs_with(study, quantity):
    """The runs that have the quantity."""
    return [r for r in study.runs
            if r["quantities"][quantity]["value"] is not None]
