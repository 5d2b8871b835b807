"""Claims, relations, figures of runs, and collections in the page."""
import contextlib
import io
import pathlib
import re
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report
import synthetic
from morsel_report import labels, style
from studies import (PageTest, a_claim, a_figure, a_food_study, a_part,
                     a_relation, a_study, without_figures, write_collection,
                     write_study)


def rows(page, heading):
    """The texts of the cells of the first table below a heading."""
    table = page.split(heading, 1)[1].split("</table>", 1)[0]
    return [[re.sub("<[^>]*>", " ", cell).strip() for cell in
             re.findall("<td[^>]*>(.*?)</td>", row)]
            for row in table.split("<tr>")[2:]]


class ClaimsTest(PageTest):
    """What publications state."""

    def test_numbers_and_words(self):
        page, figures = self.page_of(without_figures(claims=[
            a_claim(ours_deviation=0.0213, count=5),
            a_claim(stated=None, ours=None, difference=None, quantity="",
                    series="", finding="So does ours.", why=""),
            a_claim(stated=101200.0, ours=99876.5, unit="Pa",
                    difference=99876.5 / 101200 - 1)]))
        found = rows(page, "Beside what is published</h2>")
        self.assertEqual(found[0][1:4], ["1.023", "0.971 ± 0.021",
                                         "−5.06\u202f%"])
        self.assertIn("Here: K I , p = 2, mean of 5 draws", found[0][0])
        self.assertEqual(found[1][1:], ["", "", "", "So does ours."])
        self.assertEqual(found[2][1:3], ["101.2\u202fkPa", "99.88\u202fkPa"])
        self.assertEqual(figures, set())

    def test_correlation(self):
        study = a_food_study(draws=1)
        page, _ = self.page_of({**study, "claims": [a_claim(
            stated=-0.86, ours=-0.98, quantity="", series="intact",
            relation="performance_over_E")]})
        found = rows(page, "Beside what is published</h2>")[0]
        self.assertRegex(found[2], r"^−0\.9\d \(−1\.00 … −0\.\d\d\)$")
        self.assertEqual(found[3], "−0.12")
        self.assertIn("Masticatory performance against modulus", found[0])

    def test_broken_claim(self):
        page, _ = self.page_of(without_figures(claims=[
            {"name": "bad", "stated": "much", "ours": 1}, {}, a_claim()]))
        self.assertIn("The claim &#x27;bad&#x27; cannot be shown", page)
        self.assertIn("0.9712", page)


class RelationTest(PageTest):
    """How one result goes with another."""

    def test_nothing_is_known(self):
        study = a_food_study(draws=1)
        relation = study["relations"][0]
        relation.update(expected_correlation=None, expected_points=0,
                        slopes=[])
        for group in relation["groups"]:
            group["points"] = group["points"][:2]
            for name in group:
                if name not in ("series", "points"):
                    group[name] = None
        page, figures = self.page_of(study)
        self.assertIn("relation_performance_over_E", figures)
        self.assertNotIn("could not be drawn", page)
        self.assertEqual(rows(page, "What the study shows</h2>")[0],
                         ["intact foods", "2"] + 4 * ["–"])

    def test_tables(self):
        page, _ = self.page_of(a_food_study())
        self.assertIn("look bent", page)  # over two decades
        self.assertIn("1/√mm per MPa", page)
        first = rows(page, "look bent.")[0]
        self.assertEqual((first[1], first[3], first[-1]),
                         ("8", "0.002", "0.71"))
        self.assertIn("intact foods and with flaws", page)
        self.assertIn("r = −0.86 (Agrawal et al. 1997, 28 points)", page)

    def test_broken_relation(self):
        study = a_food_study()
        study["relations"] = [{"name": "empty"}, {**a_relation(
            study["runs"], "intact"), "name": "other", "y": "unknown"}]
        page, figures = self.page_of(study)
        self.assertIn("&#x27;empty&#x27; could not be drawn", page)
        self.assertIn("relation_other", figures)

    def test_labels_keep_clear(self):
        figure, axes = style.plt.subplots(layout="constrained")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        points = [(0.5, 0.5), (0.51, 0.5), (0.52, 0.51), (0.97, 0.5)]
        labels.place(axes, points, ["almond", "apple", "carrot", "parmesan"],
                     4 * ["k"], [(0.5, 0.5)])
        figure.canvas.draw()
        boxes = [text.get_window_extent().extents for text in axes.texts]
        for i, box in enumerate(boxes):
            for other in boxes[:i]:
                self.assertEqual(labels.overlap(box, other), 0)
        self.assertLess(boxes[-1][2], axes.get_window_extent().x1 + 1)
        style.plt.close(figure)


class RunFigureTest(PageTest):
    """Curves and pictures of what the runs left."""

    def test_histories(self):
        study = a_food_study(self.folder, draws=1)
        study["figures"] = [
            a_figure(runs=list(range(16))),
            a_figure(name="two", x="time [s]",
                     y="nominal_stress [Pa], force_upper_plate [N]")]
        page, figures = self.page_of(study)
        self.assertLessEqual({"figure_curves", "figure_two"}, figures)
        self.assertIn("<b>Axial stress over strain.</b> As pressed.", page)
        self.assertNotIn('class="note"', page)

    def test_missing_columns(self):
        study = a_food_study(self.folder)
        (self.folder / study["runs"][1]["folder"] / "history.csv").unlink()
        study["figures"] = [
            a_figure(), a_figure(name="unit", y="nominal_stress [kPa]"),
            a_figure(name="none", y=""), a_figure(name="far", runs=[99]),
            a_figure(name="odd", kind="odd")]
        page, figures = self.page_of(study)
        page = page.replace("&#x27;", "'")
        self.assertIn("figure_curves", figures)
        for text in ("1 of 2 runs left no history.csv (seed 2)",
                     "1 of 2 runs left no column 'nominal_stress [kPa]'",
                     "The figure 'none' could not be drawn",
                     "The figure 'far' could not be drawn",
                     "its kind is 'odd'"):
            self.assertIn(text, page)

    def test_pictures(self):
        study = a_food_study(self.folder, draws=2)
        synthetic.write_summary(self.folder / study["runs"][0]["folder"])
        study["figures"] = [
            a_figure(kind="picture", picture="force"),
            a_figure(name="lost", kind="picture", picture="moments"),
            a_figure(name="odd", kind="picture", picture="odd", runs=[0])]
        page, figures = self.page_of(study)
        page = page.replace("&#x27;", "'")
        self.assertLessEqual({"picture_curves_0", "picture_curves_1"},
                             figures)
        self.assertIn("<figcaption>Seed 2</figcaption>", page)
        self.assertIn("its fields were not kept", page)
        self.assertIn("has no figure 'odd', but moments", page)


class CollectionTest(PageTest):
    """Studies on one page."""

    def test_parts(self):
        write_study(self.folder / "parts/a", a_study(claims=[a_claim()]))
        write_study(self.folder / "parts/b", a_food_study())
        write_collection(self.folder, [
            a_part("a"), a_part("b", "failed", message="status 3: no run",
                                failed_runs=2),
            a_part("c", "not run", runs=0, wall_time=0)], quick=True)
        page = self.page()
        for text in ("The thesis, reproduced", "<p>And every table.</p>",
                     "1 of 3 studies finished, 14 runs in all. The last "
                     "command took 12\u202fmin 34\u202fs.", "7 runs, 2 failed",
                     "Failed: status 3: no run",
                     "has not been run yet", '<a href="#part2">',
                     '<h2 id="part2">', "7 runs</summary>"):
            self.assertIn(text, page)
        self.assertEqual(page.count("quick setting"), 1)
        self.assertEqual(rows(page, "Published numbers, and ours</h2>"), [
            ["Thesis, figure 3-18", "K I , p = 2", "1.023", "0.9712",
             "−5.06\u202f%"]])
        self.assertEqual(self.figures("parts/a"),
                         {"convergence_K", "work_precision_K"})
        self.assertFalse(re.search(r'(src|href)="(?!data:|#)', page))
        self.assertFalse((self.folder / "parts/a/report.html").exists())

    def test_poor_parts(self):
        (self.folder / "parts/a").mkdir(parents=True)
        (self.folder / "parts/a/study.json").write_text("{")
        write_collection(self.folder, [a_part("a"), a_part("b"), 3, {}],
                         wall_time=None, introduction=None)
        page = self.page()
        self.assertIn("is not readable", page)
        self.assertIn("Its study.json is missing", page)
        self.assertNotIn("Published numbers", page)

    def test_unreadable(self):
        for text in ("{", "[]", "{}", '{"parts": 3}'):
            (self.folder / "collection.json").write_text(text)
            with contextlib.redirect_stderr(io.StringIO()) as error:
                self.assertEqual(report.main([str(self.folder)]), 2)
            self.assertEqual(error.getvalue().count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
