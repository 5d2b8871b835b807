"""Reads what a run left; whatever is missing is empty, never an error."""
import csv
import json
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

from .vtu import read_pieces


class NoRun(Exception):
    """The folder holds nothing that a run would have left."""


class Frame:
    """One moment of one body; fields are read when they are asked for."""

    def __init__(self, time, file):
        self.time = time
        self.file = file

    def read(self, name):
        """The field as an array, scalars flat and vectors (n, 2), or None."""
        try:
            with h5py.File(self.file, "r") as h5:
                if name not in h5:
                    return None
                data = np.asarray(h5[name])
        except OSError:
            return None
        if data.ndim == 2 and data.shape[1] == 1:
            return data[:, 0]
        return data[:, :2] if data.ndim == 2 and data.shape[1] == 3 else data

    def points(self):
        """Current positions, (n, 2) [m]."""
        return self.read("nodes")


def read_series(xdmf):
    """The frames of an XDMF file and whether its cells are particles."""
    try:
        root = ElementTree.parse(xdmf).getroot()
    except (OSError, ElementTree.ParseError):
        return [], False
    frames, particles = [], False
    for grid in root.iter("Grid"):
        time = grid.find("Time")
        item = grid.find("./Geometry/DataItem")
        topology = grid.find("Topology")
        if time is None or item is None or topology is None:
            continue
        particles = topology.get("TopologyType", "").lower() == "polyvertex"
        file = xdmf.parent / (item.text or "").strip().split(":")[0]
        if file.is_file():
            frames.append(Frame(float(time.get("Value")), file))
    return frames, particles


def read_table(file):
    """A csv with header "name [unit]" as ({name: array}, {name: unit}).

    A last row that a killed run left incomplete is dropped.
    """
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
    except OSError:
        return {}, {}
    if not rows:
        return {}, {}
    names, units = [], {}
    for column in rows[0]:
        match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", column)
        names.append(match.group(1))
        units[match.group(1)] = match.group(2) or ""
    values = []
    for row in rows[1:]:
        try:
            if len(row) == len(names):
                values.append([float(x) for x in row])
        except ValueError:
            continue
    columns = np.array(values).reshape(-1, len(names)).T
    return dict(zip(names, columns)), units


class Tip:
    """One crack tip: where it is, and K over its rings."""

    def __init__(self, number, rings):
        self.number = number
        self.crack = int(rings["crack"][0])
        self.place = np.array([rings["x"][0], rings["y"][0]])
        self.direction = np.array([rings["direction_x"][0],
                                   rings["direction_y"][0]])
        self.inner = rings["inner_radius"]
        self.outer = rings["outer_radius"]
        self.mode_I = rings["stress_intensity_I"]
        self.mode_II = rings["stress_intensity_II"]

    def suffix(self, tips):
        """How summary.json tells this tip from the others."""
        among = [t.number for t in tips if t.crack == self.crack]
        k = among.index(self.number)
        text = f"_crack{self.crack}" if self.crack else ""
        return text + (f"_tip{k}" if self.crack or k else "")


class Run:
    """Everything that one run left in its folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise NoRun(f"There is no folder '{folder}'.")
        self.notes = []
        self.summary = self._read_summary()
        self.history, self.units = read_table(self.folder / "history.csv")
        self.fragments, _ = read_table(self.folder / "fragments.csv")
        self.parameters = self._read_text("used.prm")
        self.log = self._read_text("run.log")
        self.bodies, self.plates, self.elastic_plates = {}, [], []
        self.surfaces = []
        for xdmf in sorted((self.folder / "solution").glob("*.xdmf")):
            frames, particles = read_series(xdmf)
            if particles and frames:
                self.bodies[xdmf.stem] = frames
            elif frames and xdmf.stem == "elastic_plates":
                self.elastic_plates = frames
            elif frames and xdmf.stem == "surfaces":
                self.surfaces = frames
            elif frames:
                self.plates = frames
        self._read_plate()
        self._read_static_bodies()
        if not self.summary and not self.history:
            raise NoRun(
                f"The folder '{folder}' holds neither summary.json nor "
                "history.csv: no run has left its results there."
            )
        self._note_what_is_missing()

    def _read_text(self, name):
        try:
            return (self.folder / name).read_text(
                encoding="utf-8", errors="replace"
            )
        except OSError:
            return ""

    def _read_summary(self):
        text = self._read_text("summary.json")
        try:
            document = json.loads(text) if text else {}
        except json.JSONDecodeError:
            self.notes.append("summary.json is not readable.")
            return {}
        return document if isinstance(document, dict) else {}

    def _note_what_is_missing(self):
        if not self.summary:
            self.notes.append(
                "summary.json is missing: the run did not come to its end, or "
                "has not yet."
            )
        if self.is_plate():
            self._note_what_a_plate_misses()
            return
        if self.is_static():
            if not self.static_bodies:
                self.notes.append(
                    "solution/ holds no cells that can be read: there are no "
                    "pictures of the body."
                )
            return
        if not self.history:
            self.notes.append(
                "history.csv is missing: there are no curves over time."
            )
        if not self.bodies:
            self.notes.append(
                "solution/ holds no particle fields: there are no pictures of "
                "the food."
            )

    def _note_what_a_plate_misses(self):
        if self.plate is None:
            self.notes.append(
                "solution/ holds no plate that can be read: there are no "
                "pictures of it."
            )
        if not self.tips and any(n.startswith("stress_intensity")
                                 for n in self.results()):
            self.notes.append(
                "stress_intensity.csv is missing: there are no rings."
            )

    def is_plate(self):
        """Whether this was a cracked plate rather than a body of a scene."""
        kind = self.text("kind")
        return kind == "cracked plate" or (
            not kind and not self.history
            and any(n.startswith("stress_intensity_")
                    for n in self.results()))

    def is_static(self):
        """Whether particle bodies were brought into static equilibrium."""
        return self.text("kind") == "static equilibrium"

    def is_experiment(self):
        """Whether particle bodies were loaded by other things than plates."""
        return "minimum_spacing" in self.history and (
            "closure" not in self.history)

    def _read_plate(self):
        solution = self.folder / "solution"
        self.plate = read_pieces(solution, "plate")
        self.nodes = read_pieces(solution, "enriched_nodes")
        self.cracks = read_pieces(solution, "cracks")
        rings, _ = read_table(self.folder / "stress_intensity.csv")
        self.tips = []
        for number in np.unique(rings.get("tip", [])):
            here = {name: values[rings["tip"] == number]
                    for name, values in rings.items()}
            self.tips.append(Tip(int(number), here))
        self.opening, _ = read_table(self.folder / "crack_opening.csv")
        self.tip_stress, _ = read_table(self.folder / "tip_stress.csv")

    def _read_static_bodies(self):
        """{name: (cells, outline)} of the bodies in equilibrium."""
        self.static_bodies = {}
        solution = self.folder / "solution"
        for file in sorted(solution.glob("*_cells.vtu")):
            name = file.stem[:-len("_cells")]
            cells = read_pieces(solution, file.stem)
            if cells is not None:
                self.static_bodies[name] = (
                    cells, read_pieces(solution, name + "_outline"))

    def results(self):
        """The scalar results, {name: entry with "value" and "unit"}."""
        return {
            name: entry
            for name, entry in self.summary.items()
            if isinstance(entry, dict)
            and isinstance(entry.get("value"), (int, float))
        }

    def value(self, name, default=None):
        """The value of a scalar result, SI, or the default."""
        entry = self.results().get(name)
        return default if entry is None else float(entry["value"])

    def text(self, name, default=""):
        """A text of the summary, or the default."""
        texts = self.summary.get("text", {})
        return texts.get(name, default) if isinstance(texts, dict) else default

    def parameter(self, key, default):
        """The value of an entry of used.prm whose key is unique there."""
        match = re.search(rf"^\s*set\s+{re.escape(key)}\s*=\s*(.*?)\s*$",
                          self.parameters, re.MULTILINE)
        return match.group(1) if match else default

    def column(self, name):
        """A column of the history, or None."""
        return self.history.get(name)

    def plate_names(self):
        """The plates whose normal force the history holds."""
        return [n[len("force_"):] for n in self.history
                if n.startswith("force_")]

    def at(self, name, time):
        """A column of the history at a time, or None."""
        t, y = self.column("time"), self.column(name)
        if t is None or y is None or len(t) == 0:
            return None
        return float(np.interp(time, t, y))

    def mean_force(self):
        """The mean of the plates' normal forces over time, or None."""
        names = self.plate_names()
        if not names:
            return None
        return np.mean([self.history["force_" + n] for n in names], axis=0)

    def peak_time(self):
        """When the mean force was largest [s], or None."""
        force, t = self.mean_force(), self.column("time")
        if force is None or t is None or len(t) == 0 or np.max(force) <= 0:
            return None
        return float(t[int(np.argmax(force))])

    def food(self):
        """The frames of the largest particle body, and its name."""
        if not self.bodies:
            return [], ""

        def size(name):
            points = self.bodies[name][0].points()
            return 0 if points is None else len(points)

        name = max(self.bodies, key=size)
        return self.bodies[name], name
