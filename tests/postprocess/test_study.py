"""The page of a study, from a small study.json."""
import contextlib
import io
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report
from studies import (PageTest, a_food_study, a_run, a_sensitivity_study,
                     a_study, an_axis, without_figures)


class StudyTest(PageTest):
    """What varies calls for figures."""

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

    def test_tornado(self):
        page, figures = self.page_of(a_sensitivity_study())
        self.assertEqual(figures, {"tornado_K"})
        self.assertNotIn("could not be drawn", page)
        for text in ("<i>hourglass coefficient</i>", "×0.9", "<b>beyond</b>",
                     "+10 ±\u202f2\u202f%", "−4\u202f%",
                     "Beyond the bound of the method: hourglass coefficient",
                     "4 of 5 runs finished", "hourglass = 0.5: status 2"):
            self.assertIn(text, page)
        # The largest comes first, and variations are no runs of their own.
        self.assertLess(page.index("modulus"),
                        page.index("<i>hourglass coefficient</i>"))
        self.assertIn("All runs", page)

    def test_tornado_without_its_other_end(self):
        document = a_sensitivity_study()
        for change in document["sensitivity_changes"]:
            change["high"] = None
        page, figures = self.page_of(document)
        self.assertEqual(figures, {"tornado_K"})
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

    def test_draws_over_the_resolution(self):
        runs = []
        for n in (10, 20, 40):
            for seed in (1, 2, 3):
                run = a_run("p1", n, 0.01 * seed / n)
                run["axes"] = {"n": n, "seed": seed}
                runs.append(run)
        axes = {"n": an_axis("cells"), "seed": an_axis("seed", "seeds")}
        page, figures = self.page_of(a_study(
            runs=runs, axes=axes, timing=False, time_to_reach=[], rates=[],
            pareto_fronts=[]))
        self.assertEqual(figures, {"draws_over_resolution_K"})
        self.assertNotIn("could not be drawn", page)

    def test_draws_of_several_settings(self):
        page, figures = self.page_of(a_food_study())
        self.assertEqual(figures, {"draws_by_setting_performance",
                                   "relation_performance_over_E"})
        self.assertNotIn("could not be drawn", page)

    def test_old_figures_do_not_stay(self):
        (self.folder / "figures").mkdir()
        for name in ("relation_old", "picture_old_1", "figure_old", "other"):
            (self.folder / "figures" / f"{name}.png").write_bytes(b"old")
        _, figures = self.page_of(a_study())
        self.assertEqual(figures, {"convergence_K", "work_precision_K",
                                   "other"})

    def test_quick_setting(self):
        self.assertNotIn("quick setting", self.page_of(without_figures())[0])
        self.assertIn("quick setting",
                      self.page_of(without_figures(quick=True))[0])

    def test_missing_and_broken_members(self):
        page, _ = self.page_of(without_figures(
            rates=5, claims=[3], statistics=None, figures={},
            relations="none"))
        for name in ("rates", "claims", "figures", "relations"):
            self.assertIn(f"study.json: &#x27;{name}&#x27; cannot be read",
                          page)
        bare = without_figures()
        for name in ("rates", "pareto_fronts", "time_to_reach", "statistics",
                     "timing", "resolution", "title", "program_version"):
            bare.pop(name)
        self.assertIn("7 of 7 runs finished", self.page_of(bare)[0])

    def test_unreadable(self):
        for text in ("{", "[]", "{}", '{"runs": 3}'):
            (self.folder / "study.json").write_text(text)
            with contextlib.redirect_stderr(io.StringIO()) as error:
                self.assertEqual(report.main([str(self.folder)]), 2)
            self.assertEqual(error.getvalue().count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
