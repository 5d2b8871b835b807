"""The report on a complete run, on poor ones, and on what is no run.

Run with: python3 -m unittest discover -s tests/postprocess
"""
import contextlib
import io
import json
import pathlib
import re
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import matplotlib.pyplot as plt
import numpy as np

import report
import synthetic
from morsel_report import food, reader, style, teeth, tooth_cracks


class ReportTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name) / "run"
        self.folder.mkdir()

    def report(self):
        """Makes the report; its text."""
        with contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(report.main([str(self.folder)]), 0)
        self.assertIn("report.html", out.getvalue())
        return (self.folder / "report.html").read_text(encoding="utf-8")

    def figures(self):
        """The names of the figures that were saved."""
        return {f.stem for f in (self.folder / "figures").glob("*.png")}

    def test_complete_run(self):
        synthetic.write_run(self.folder, across=31)
        page = self.report()
        self.assertEqual(self.figures(), {
            "moments", "fragments", "force", "stress_strain", "energy",
            "fragment_sizes", "fragment_distribution", "failed_share"})
        self.assertEqual(page.count("data:image/png;base64,"), 8)
        for text in ("Roasted peanut, one chewing stroke", "broke completely",
                     "101.5\u202fkPa", "not quasi-static", "9f2c41d7",
                     "1.31", "artificial viscosity",
                     "ran at 24\u00b0 to the direction of loading"):
            self.assertIn(text, page)
        # Nothing is fetched, and nothing is a script.
        self.assertFalse(re.search(r'(src|href)="(?!data:)', page))
        self.assertNotIn("<script", page)

    def test_plates_that_deform(self):
        synthetic.write_run(self.folder, across=11)
        nodes = [[0.0, 0.01], [0.01, 0.01], [0.01, 0.011], [0.0, 0.011]]
        synthetic.write_frames(
            self.folder / "solution", "elastic_plates", "Quadrilateral",
            [(0.0, {"nodes": nodes, "cells": [[0, 1, 2, 3]],
                    "plate": [1.0] * 4, "von_mises": [1e3] * 4})])
        run = reader.Run(self.folder)
        figure, axes = plt.subplots()
        self.addCleanup(plt.close, figure)
        food.draw_plates(axes, run, 0.0, "von_mises",
                         lambda values: ["red"] * len(values))
        # Cells and outline of this plate, then of the other, which is rigid.
        self.assertEqual(len(axes.collections), 4)
        self.assertEqual(tuple(axes.collections[0].get_facecolor()[0]),
                         (1.0, 0.0, 0.0, 1.0))
        self.assertEqual(len(axes.collections[2].get_paths()), 1)
        self.report()

    def test_outline_of_cells(self):
        # Two cells side by side, with nodes of their own: six outer edges;
        # a triangle is a cell with a corner twice.
        nodes = 1e-3 * np.array([[0, 0], [1, 0], [1, 1], [0, 1],
                                 [1, 0], [2, 0], [2, 1], [1, 1],
                                 [2, 0], [3, 0], [2, 1], [2, 1]])
        cells = np.arange(12).reshape(3, 4)
        self.assertEqual(len(teeth.edges_of(nodes, cells[:2])), 6)
        self.assertEqual(len(teeth.edges_of(nodes, cells)), 7)
        # A cell beside two of half its size: three and three sides, and two.
        half = 1e-3 * np.array([[-0.5, 0], [0, 0], [0, 0.5], [-0.5, 0.5]])
        nodes = np.concatenate([nodes[:4], half, half + [0, 5e-4]])
        self.assertEqual(len(teeth.edges_of(nodes, cells)), 3 + 2 * 2 + 0)

    def test_forces_on_teeth(self):
        synthetic.write_run(self.folder, across=11)
        synthetic.write_frames(
            self.folder / "solution", "surfaces", "Polyline",
            [(0.0, {"nodes": [[0, 0.01], [0.004, 0.01], [0.004, 0.01],
                              [0.01, 0.01]],
                    "cells": [[0, 1], [2, 3]], "plate": [1.0] * 4,
                    "traction": [[0, 0, 0], [0, 2e4, 0], [0, 2e4, 0],
                                 [0, 0, 0]]})])
        (self.folder / "surface_forces.csv").write_text(
            "plate [1],arc_length [m],x [m],y [m],normal_pressure [Pa],"
            "tangential_traction [Pa]\n0,0,0,0,0,0\n0,0.01,0.01,0,0,0\n"
            "1,0,0,0.01,0,0\n1,0.004,0.004,0.01,2e4,3e3\n"
            "1,0.01,0.01,0.01,0,0\n", encoding="utf-8")
        run = reader.Run(self.folder)
        force, centre = teeth.loads(run.surfaces[0], 0.01)[1]
        self.assertAlmostEqual(force[1], 0.01 * 0.01 * 1e4)
        self.assertAlmostEqual(centre[0], 0.4 * 0.002 + 0.6 * 0.007)
        self.report()
        self.assertIn("tractions", self.figures())

    def test_cracked_teeth(self):
        synthetic.write_run(self.folder, across=11)
        file = self.folder / "history.csv"
        lines = file.read_text(encoding="utf-8").splitlines()
        names = [f"stress_intensity_{mode}_lower_plate{tip} [Pa sqrt(m)]"
                 for tip in ("", "_tip1") for mode in ("I", "II")]
        rows = [",".join([lines[0]] + names)]
        for i, line in enumerate(lines[1:]):
            rows.append(f"{line},{2e3 * i},{1e2 * i},{-1e3 * i},0")
        file.write_text("\n".join(rows) + "\n", encoding="utf-8")
        file = self.folder / "summary.json"
        summary = json.loads(file.read_text(encoding="utf-8"))
        for tip in ("", "_tip1"):
            for name, value in (
                    ("fracture_toughness", 1e6),
                    ("largest_equivalent_stress_intensity", 1.2e6),
                    ("time_of_largest_equivalent_stress_intensity", 0.02),
                    ("crack_would_grow", 0.0 if tip else 1.0)):
                summary[f"{name}_lower_plate{tip}"] = {
                    "value": value, "unit": "1", "meaning": ""}
        for name, value in (("time_of", 0.017), ("force_at", 9.0)):
            summary[f"{name}_crack_growth_lower_plate"] = {
                "value": value, "unit": "1", "meaning": ""}
        file.write_text(json.dumps(summary), encoding="utf-8")
        # One cell in two pieces, apart.
        nodes = [[0.0, -0.001], [0.004, -0.001], [0.004, 0.0], [0.0, 0.0],
                 [0.004, -0.001], [0.01, -0.001], [0.01, 0.0], [0.004, 0.0]]
        synthetic.write_frames(
            self.folder / "solution", "elastic_plates", "Quadrilateral",
            [(0.0, {"nodes": nodes, "cells": [[0, 1, 2, 3], [4, 5, 6, 7]],
                    "plate": [0.0] * 8, "von_mises": [1e3] * 8,
                    "displacement": [[-1e-6, 0, 0]] * 4
                    + [[1e-6, 0, 0]] * 4})])
        run = reader.Run(self.folder)
        self.assertEqual(tooth_cracks.tips(run),
                         ["lower_plate", "lower_plate_tip1"])
        self.assertEqual(tooth_cracks.label(run, "lower_plate_tip1"),
                         "lower plate, tip 1")
        page = self.report()
        self.assertIn("would grow from a force of 9\u202fN on", page)
        self.assertLessEqual({"tooth_cracks", "open_cracks"}, self.figures())

    def test_scene_without_damage(self):
        synthetic.write_fields(self.folder, across=11, fields=False)
        synthetic.write_history(self.folder, complete=False)
        synthetic.write_summary(self.folder)
        self.report()
        self.assertEqual(self.figures(), {"moments", "force",
                                          "stress_strain"})

    def test_plate_without_fields(self):
        (self.folder / "summary.json").write_text(json.dumps({
            "stress_intensity_I": synthetic.entry(
                663.1, "Pa sqrt(m)", "by interaction integral", 663.4)}),
            encoding="utf-8")
        page = self.report()
        self.assertEqual(self.figures(), set())
        self.assertIn("663.1\u202fPa √m", page)
        self.assertIn("no plate that can be read", page)
        self.assertNotIn("history.csv", page)

    def test_run_that_was_killed(self):
        synthetic.write_history(self.folder)
        with open(self.folder / "history.csv", "a",
                  encoding="utf-8") as stream:
            stream.write("0.1,0.2")
        page = self.report()
        self.assertIn("summary.json is missing", page)
        self.assertIn("energy", self.figures())

    def test_old_figures_do_not_stay(self):
        synthetic.write_history(self.folder, complete=False)
        (self.folder / "figures").mkdir()
        (self.folder / "figures" / "energy.png").write_bytes(b"old")
        self.report()
        self.assertNotIn("energy", self.figures())

    def test_no_run(self):
        for folder in (self.folder, self.folder / "nowhere"):
            with contextlib.redirect_stderr(io.StringIO()) as error:
                self.assertEqual(report.main([str(folder)]), 2)
            self.assertEqual(error.getvalue().count("\n"), 1)
            self.assertIn(str(folder), error.getvalue())

    def test_reading(self):
        synthetic.write_run(self.folder, across=11)
        run = reader.Run(self.folder)
        frames, name = run.food()
        self.assertEqual(name, "food")
        self.assertEqual(len(frames), 21)
        self.assertEqual(frames[0].points().shape, (121, 2))
        self.assertEqual(frames[0].read("velocity").shape, (121, 2))
        self.assertAlmostEqual(food.spacing_of(frames[0].points()),
                               0.01 / 11, places=9)
        self.assertEqual(run.plate_names(), ["upper_plate", "lower_plate"])
        self.assertEqual(run.units["nominal_stress"], "Pa")

    def test_numbers(self):
        self.assertEqual(style.quantity(101200.0, "Pa"), "101.2\u202fkPa")
        self.assertEqual(style.quantity(0.0045, "J", 3), "4.50\u202fmJ")
        self.assertEqual(style.quantity(10201, "1"), "10\u202f201")
        self.assertEqual(style.quantity(1.5, "1/sqrt(mm)", 3),
                         "1.50\u202f1/√mm")
        self.assertEqual(style.percent(-0.2), "−20.0\u202f%")
        self.assertEqual(style.quantity(0.0, "N"), "0\u202fN")


if __name__ == "__main__":
    unittest.main()
