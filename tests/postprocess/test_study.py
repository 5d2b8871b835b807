"""The page of a study, from a small study.json."""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report


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
        "quantities": {"K": {"label": "K_I", "unit": "Pa sqrt(m)",
                             "meaning": "by rings", "truth": "formula",
                             "truth_formula": "1", "truth_accuracy": 1e-7,
                             "error_scale": 0}},
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


class StudyTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def page_of(self, document):
        """Makes the report of a study; its text and its figures."""
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        folder = pathlib.Path(temporary.name)
        (folder / "study.json").write_text(json.dumps(document),
                                           encoding="utf-8")
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(folder)]), 0)
        figures = {f.stem for f in (folder / "figures").glob("*.png")}
        return (folder / "report.html").read_text(encoding="utf-8"), figures

    def test_convergence_and_cost(self):
        page, figures = self.page_of(a_study())
        self.assertEqual(figures, {"convergence_K", "work_precision_K"})
        for text in ("A small study", "7 of 7 runs finished", "1.90 … 2.10",
                     "<b>≤\u202f10\u202fms</b>", "K<sub>I</sub>"):
            self.assertIn(text, page)
        self.assertNotIn("could not be drawn", page)
        self.assertNotIn("<script", page)

    def test_failed_and_waiting_runs(self):
        runs = a_study()["runs"]
        runs += [a_run("p2", 80, 0, "failed"), a_run("p2", 160, 0, "not run")]
        page, _ = self.page_of(a_study(runs=runs))
        self.assertIn("status 2: the radius is too large", page)
        self.assertIn("1 of 9 runs have not been carried out", page)

    def test_over_an_axis(self):
        runs = []
        for theta in (0.0, 15.0, 30.0):
            runs.append(a_run("p1", 10, 1e-3 * (theta + 1)))
            runs[-1]["axes"]["theta"] = theta
        page, figures = self.page_of(a_study(
            runs=runs, rates=[], pareto_fronts=[], time_to_reach=[],
            timing=False))
        self.assertEqual(figures, {"over_axis_K"})
        self.assertNotIn("could not be drawn", page)

    def test_over_two_axes(self):
        runs = []
        for theta in (0.0, 15.0, 30.0):
            for n in (1, 2, 3):
                runs.append(a_run("p1", n, 1e-3 * (theta + n)))
                runs[-1]["axes"]["theta"] = theta
                runs[-1]["resolution"] = None
        page, figures = self.page_of(a_study(
            runs=runs, rates=[], pareto_fronts=[], time_to_reach=[],
            timing=False))
        self.assertEqual(figures, {"over_two_axes_K"})
        self.assertNotIn("could not be drawn", page)

    def test_side_by_side(self):
        runs = [a_run(series, 10, error) for series, error in (
            ("p1", 0.02), ("p2", -0.01), ("p2", 0.001))]
        page, figures = self.page_of(a_study(
            runs=runs, rates=[], pareto_fronts=[], time_to_reach=[],
            timing=False))
        self.assertEqual(figures, {"side_by_side_K"})
        self.assertNotIn("could not be drawn", page)

    def test_stability(self):
        axes = {"kernel": an_axis("kernel", "texts"),
                "ratio": an_axis("h/dp"), "stress": an_axis("stress over E")}
        runs = []
        for ratio in (1.0, 1.3, 2.0):
            for stress in (-1e-2, 1e-3, 1e-2):
                runs.append(a_run("p1", 10, stress * ratio))
                runs[-1]["axes"] = {"kernel": "quadratic", "ratio": ratio,
                                    "stress": stress}
        page, figures = self.page_of(a_study(
            runs=runs, axes=axes, rates=[], pareto_fronts=[],
            time_to_reach=[], timing=False))
        self.assertEqual(figures, {"kernels_all", "stability_K"})
        self.assertNotIn("could not be drawn", page)

    def test_draws(self):
        runs = [a_run("p1", n, 1e-4 * (n % 7 - 3)) for n in range(2, 40)]
        axes = {"n": an_axis("seed", "seeds"), "theta": an_axis("angle")}
        page, figures = self.page_of(a_study(
            runs=runs, axes=axes, timing=False, time_to_reach=[]))
        self.assertEqual(figures, {"draws_K"})
        self.assertNotIn("could not be drawn", page)

    def test_unreadable(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        (pathlib.Path(temporary.name) / "study.json").write_text("{")
        with contextlib.redirect_stderr(io.StringIO()) as error:
            self.assertEqual(report.main([temporary.name]), 2)
        self.assertEqual(error.getvalue().count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
