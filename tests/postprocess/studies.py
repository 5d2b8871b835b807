"""Invented studies and collections, as the program writes them."""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report
import synthetic


class PageTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def page(self):
        """Makes the report of the folder; its text."""
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(self.folder)]), 0)
        return (self.folder / "report.html").read_text(encoding="utf-8")

    def figures(self, folder="."):
        """The names of the figures that were saved."""
        return {f.stem for f in
                (self.folder / folder / "figures").glob("*.png")}

    def page_of(self, document):
        """Makes the report of a study; its text and its figures."""
        write_study(self.folder, document)
        return self.page(), self.figures()


def a_run(series, n, error, status="finished"):
    """One run: error of K at n cells."""
    done = status == "finished"
    return {"series": series, "axes": {"n": n, "theta": 30.0},
            "status": status, "message": "" if done else
            "status 2: the radius is too large", "kept": False,
            "folder": f"runs/{series}{n}", "resolution": n if done else None,
            "quantities": {"K": {"value": 1 + error if done else None,
                                 "truth": 1.0 if done else None,
                                 "error": error if done else None}},
            "time": 1e-3 * n if done else None,
            "time_low": 0.9e-3 * n if done else None,
            "time_high": 1.2e-3 * n if done else None, "repetitions": 3,
            "wall_time": 1.0, "cpu_time": 0.5,
            "memory": 1e8 + 1e4 * n ** 2 if done else None,
            "unknowns": 2 * n ** 2 if done else None}


def an_axis(label, kind="numbers"):
    """An axis of study.json."""
    return {"label": label, "unit": "1", "kind": kind, "together_with": ""}


def a_quantity(label, unit, truth="none", **more):
    """A quantity of study.json."""
    return {"label": label, "unit": unit, "meaning": "by rings",
            "truth": truth, "truth_formula": "1", "truth_accuracy": 1e-7,
            "error_scale": 0, **more}


def a_study(**more):
    """Two series, four meshes; second order and fourth order."""
    runs = [a_run("p1", n, n ** -2.0) for n in (10, 20, 40, 80)]
    runs += [a_run("p2", n, n ** -4.0) for n in (10, 20, 40)]
    document = {
        "name": "test", "title": "A small study", "study": "s.prm",
        "program_version": "0.1.0", "timing": True, "threads": 1,
        "resolution": {"formula": "n", "label": "cells along a side"},
        "axes": {"n": an_axis("cells along a side"),
                 "theta": an_axis("angle")},
        "series": [{"name": "p1", "title": "p = 1", "base_scene": "a.prm"},
                   {"name": "p2", "title": "p = 2", "base_scene": "a.prm"}],
        "quantities": {"K": a_quantity("K_I", "Pa sqrt(m)", "formula")},
        "runs": runs,
        "rates": [{"quantity": "K", "series": "p1", "at": {"theta": "30"},
                   "rate": 2.0, "low": 1.9, "high": 2.1, "constant": 1.0,
                   "points": 4}],
        "pareto_fronts": [{"quantity": "K", "cost": "time", "runs": [4, 5]}],
        "time_to_reach": [
            {"quantity": "K", "series": "p2", "levels": [
                {"error": 0.1, "kind": "at most", "time": 0.01},
                {"error": 0.0001, "kind": "interpolated", "time": 0.015}]},
            {"quantity": "K", "series": "p1", "levels": [
                {"error": 0.1, "kind": "at most", "time": 0.02},
                {"error": 0.0001, "kind": "not reached", "time": None}]}],
        "statistics": []}
    document.update(more)
    return document


def without_figures(**more):
    """A study whose quantity is recorded, but not drawn by itself."""
    return a_study(quantities={"K": a_quantity(
        "K_I", "Pa sqrt(m)", "formula", drawn=False)}, **more)


def a_claim(**more):
    """A claim of study.json: a number beside a quantity's."""
    claim = {"name": "limit", "source": "Thesis, figure 3-18",
             "says": "The factor converges to 1.023 of the formula.",
             "stated": 1.023, "ours": 0.9712, "ours_deviation": None,
             "count": 1, "difference": 0.9712 / 1.023 - 1, "unit": "1",
             "quantity": "K", "relation": "", "series": "p2", "at": "",
             "finding": "", "note": "",
             "why": "The plate between clamps is stiffer than the strip that "
                    "the formula is of."}
    claim.update(more)
    return claim


def an_end(value, change, error=None):
    """One end of a variation."""
    return {"value": value, "change": change, "standard_error": error,
            "count": 3 if error else 1}


def a_sensitivity_study():
    """One run, with an entry of the scene and one of the method varied."""
    runs = [a_run("p1", 10, 0.01) for _ in range(4)]
    runs.append(a_run("p1", 10, 0, "failed"))
    runs[0]["variation"] = None
    for run, (name, side, value) in zip(runs[1:], (
            ("modulus", "low", 0.9e9), ("modulus", "high", 1.1e9),
            ("hourglass", "high", 1.0), ("hourglass", "low", 0.5))):
        run["variation"] = {"sensitivity": name, "side": side, "value": value}
    common = {"quantity": "K", "series": "p1", "at": {"theta": "30"}}
    return a_study(
        runs=runs, rates=[], pareto_fronts=[], time_to_reach=[], timing=False,
        series=[{"name": "p1", "title": "p = 1", "base_scene": "a.prm"}],
        sensitivities=[
            {"name": "modulus", "label": "Young's modulus", "low": 0.9,
             "high": 1.1, "relative": True, "numerical": False, "bound": None},
            {"name": "hourglass", "label": "hourglass coefficient", "low": 0.5,
             "high": 1.0, "relative": False, "numerical": True,
             "bound": 0.03}],
        sensitivity_changes=[
            {**common, "sensitivity": "hourglass", "size": 0.04,
             "beyond_bound": True, "low": None, "high": an_end(1.0, -0.04)},
            {**common, "sensitivity": "modulus", "size": 0.1,
             "beyond_bound": False, "low": an_end(0.9e9, -0.1, 0.01),
             "high": an_end(1.1e9, 0.1, 0.02)}])


FOODS = ["raw carrot", "apple", "peanut", "almond", "brittle candy",
         "hard biscuit", "raw potato", "parmesan"]


def a_food_study(folder=None, draws=3):
    """Performance over modulus of eight foods in two series, with relations;
    where a folder is given, with histories of the runs there."""
    random = np.random.default_rng(1)
    runs = []
    for s, series in enumerate(("intact", "flawed")):
        for food, modulus in zip(FOODS, np.geomspace(2e6, 4e8, len(FOODS))):
            for seed in range(1, draws + 1):
                run = a_run(series, seed, 0.0)
                run["axes"] = {"food": food, "seed": seed}
                run["resolution"] = None
                run["folder"] = f"runs/{series}_{food.replace(' ', '_')}_{seed}"
                value = (2.2 - 0.35 * s - 4e-9 * modulus
                         + 0.15 * random.standard_normal())
                run["quantities"] = {
                    name: {"value": v, "truth": None, "error": None}
                    for name, v in (("E", modulus), ("performance", value))}
                runs.append(run)
                if folder:
                    (folder / run["folder"]).mkdir(parents=True)
                    synthetic.write_history(folder / run["folder"], False)
    axes = {"food": an_axis("food", "texts"), "seed": an_axis("seed", "seeds")}
    return a_study(
        axes=axes, runs=runs, rates=[], pareto_fronts=[], time_to_reach=[],
        timing=False, series=[
            {"name": "intact", "title": "intact foods", "base_scene": "a.prm"},
            {"name": "flawed", "title": "with flaws", "base_scene": "a.prm"}],
        quantities={"E": a_quantity("Young's modulus", "Pa", drawn=False),
                    "performance": a_quantity("masticatory performance",
                                              "1/sqrt(mm)")},
        relations=[a_relation(runs, "intact", "flawed")])


def a_group(runs, series):
    """The means over the draws of a series, with their regression."""
    points = []
    for food in FOODS:
        own = [r["quantities"] for r in runs
               if r["series"] == series and r["axes"]["food"] == food]
        x, y = (np.array([q[name]["value"] for q in own])
                for name in ("E", "performance"))
        points.append({
            "x": x.mean(), "y": y.mean(), "count": len(own),
            "x_deviation": 0.0, "y_deviation": y.std(ddof=1)
            if len(own) > 1 else 0.0, "label": food})
    x, y = (np.array([p[name] for p in points]) for name in "xy")
    slope, intercept = np.polyfit(x, y, 1)
    rest = y - intercept - slope * x
    # 2.447: Student's t for 6 degrees of freedom at 97.5 %.
    half = 2.447 * np.sqrt(rest @ rest / 6 / np.sum((x - x.mean()) ** 2))
    r = np.corrcoef(x, y)[0, 1]
    low, high = np.tanh(np.arctanh(r) + np.array([-1, 1]) * 1.96 / np.sqrt(5))
    return {"series": series, "points": points, "count": len(points),
            "correlation": r, "correlation_low": low, "correlation_high": high,
            "p_value": 0.002, "slope": slope, "slope_low": slope - half,
            "slope_high": slope + half, "intercept": intercept,
            "expected_p_value": 0.71}


def a_relation(runs, *series):
    """A relation of study.json."""
    return {"name": "performance_over_E",
            "label": "Masticatory performance against modulus", "x": "E",
            "y": "performance", "expected_correlation": -0.86,
            "expected_points": 28, "source": "Agrawal et al. 1997",
            "groups": [a_group(runs, s) for s in series],
            "slopes": [{"first": "intact", "second": "flawed",
                        "difference": 2.4e-10, "p_value": 0.43}]}


def a_figure(**more):
    """A figure of study.json: curves of the runs' histories."""
    return {"name": "curves", "kind": "history",
            "title": "Axial stress over strain", "caption": "As pressed.",
            "x": "nominal_strain [1]", "y": ["nominal_stress [Pa]"],
            "picture": "", "runs": [0, 1], **more}


def write_study(folder, document):
    """study.json of a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "study.json").write_text(json.dumps(document), encoding="utf-8")


def a_part(name, status="finished", **more):
    """A part of collection.json."""
    return {"name": name, "title": f"The study {name}", "file": f"{name}.prm",
            "folder": f"parts/{name}", "status": status, "message": "",
            "runs": 7, "failed_runs": 0, "wall_time": 83.0, **more}


def write_collection(folder, parts, **more):
    """collection.json of a folder."""
    document = {"name": "thesis", "title": "The thesis, reproduced",
                "introduction": "Every figure.\n\nAnd every table.",
                "quick": False, "program_version": "0.1.0",
                "collection": "all.prm", "wall_time": 754.0, "parts": parts}
    document.update(more)
    (folder / "collection.json").write_text(json.dumps(document),
                                            encoding="utf-8")
