"""The report on a cracked plate, from files like the program's and from a run.

The program itself is run where the environment's MORSEL names it.
"""
import base64
import contextlib
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report
import synthetic
from morsel_report import plate, reader, vtu

SCENES = HERE.parent.parent / "prm" / "fracture"
MORSEL = os.environ.get("MORSEL", "")


def array(name, values, kind="Float64", components=1):
    """One DataArray as the program writes it."""
    data = np.asarray(values, vtu.TYPES[kind]).tobytes()
    text = base64.b64encode(np.uint64(len(data)).tobytes() + data).decode()
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents='
            f'"{components}" format="binary">{text}</DataArray>')


def grid_text(points, offsets, kind, point_fields="", cell_fields=""):
    """A vtu file."""
    points = np.hstack([points, np.zeros((len(points), 1))])
    return (
        '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="1.0" '
        'byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(offsets)}'
        f'"><Points>{array("points", points, components=3)}</Points><Cells>'
        + array("connectivity", np.arange(len(points)), "Int32")
        + array("offsets", offsets, "Int32")
        + array("types", np.full(len(offsets), kind), "UInt8")
        + f"</Cells><PointData>{point_fields}</PointData>"
        f"<CellData>{cell_fields}</CellData></Piece></UnstructuredGrid>"
        "</VTKFile>")


def write_squares(folder, ranks=2):
    """Unit squares [mm], one a rank, under a stretch along y."""
    for rank in range(ranks):
        corners = 1e-3 * (np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
                          + [rank, 0])
        u = np.hstack([0 * corners[:, :1], 1e-3 * corners[:, 1:],
                       0 * corners[:, :1]])
        fields = (array("displacement", u, components=3)
                  + array("von_mises_stress", [1e3, 2e3, 3e3, 4e3]))
        (folder / f"plate_{rank}.vtu").write_text(grid_text(
            corners, [4], 7, fields, array("cell", [0.0])
            + array("degree", [2.0])))
    (folder / "plate.pvd").write_text(
        '<VTKFile type="Collection"><Collection>'
        + "".join(f'<DataSet part="{k}" file="plate_{k}.vtu"/>'
                  for k in range(ranks)) + "</Collection></VTKFile>")


class PlateTest(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "solution").mkdir()

    def report(self):
        """Makes the report; its text."""
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(self.folder)]), 0)
        return (self.folder / "report.html").read_text(encoding="utf-8")

    def figures(self):
        """The names of the figures that were saved."""
        return {f.stem for f in (self.folder / "figures").glob("*.png")}

    def test_ranks_are_joined(self):
        write_squares(self.folder / "solution")
        grid = vtu.read_pieces(self.folder / "solution", "plate")
        self.assertEqual(grid.points.shape, (8, 2))
        self.assertEqual(list(grid.offsets), [4, 8])
        self.assertEqual(grid.triangles().tolist(),
                         [[0, 1, 2], [4, 5, 6], [0, 2, 3], [4, 6, 7]])
        lower, upper = plate.cell_boxes(grid)
        np.testing.assert_allclose(lower, [[0, 0], [1e-3, 0]])
        np.testing.assert_allclose(upper, [[1e-3, 1e-3], [2e-3, 1e-3]])

    def test_plate_without_cracks(self):
        write_squares(self.folder / "solution")
        (self.folder / "summary.json").write_text(json.dumps({
            "strain_energy": synthetic.entry(1e-6, "J/m", "of the plate"),
            "text": {"kind": "cracked plate", "title": "Whole"}}))
        page = self.report()
        self.assertEqual(self.figures(), {"deformed"})
        self.assertIn("of 2 by 1 mm without a crack", page)
        self.assertNotIn("missing", page)

    def test_broken_fields(self):
        (self.folder / "solution" / "plate.vtu").write_text("<VTKFile>")
        (self.folder / "summary.json").write_text(json.dumps({
            "text": {"kind": "cracked plate"}}))
        self.assertIn("no plate that can be read", self.report())

    def test_round_numbers(self):
        for x, expected in ((0.7, 0.5), (1.0, 1.0), (4999.0, 2000.0),
                            (5000.0, 5000.0)):
            self.assertAlmostEqual(plate.round_number(x), expected)

    def run_scene(self, scene, *options, command=()):
        """Runs the program; the reader's view of what it left."""
        subprocess.run(
            [*command, MORSEL, str(SCENES / scene), "--output",
             str(self.folder), "--quiet", "--threads", "1", "--set",
             "XFEM/Degree=2", "--set", "XFEM/Tip degree=2", "--set",
             "XFEM/Corner refinements=1", *options], check=True)
        return reader.Run(self.folder)

    @unittest.skipUnless(MORSEL, "MORSEL does not name the program")
    def test_run_of_an_edge_crack(self):
        run = self.run_scene("m1_xfem.prm")
        page = self.report()
        self.assertEqual(self.figures(), {
            "deformed", "tip_field", "tip_lines", "enrichment",
            "ring_values", "opening"})
        for text in ("Edge crack in tension", "with 1 crack and 1 tip",
                     "K<sub>II</sub>", "64.4352", "above the reference"
                     if run.value("stress_intensity_I") > 64.4352
                     else "below the reference"):
            self.assertIn(text, page)
        self.assertFalse(re.search(r'(src|href)="(?!data:)', page))
        # Each side of the crack has a displacement of its own.
        grid = run.plate
        on_crack = ((np.abs(grid.points[:, 1] - 5e-3) < 1e-9)
                    & (grid.points[:, 0] < 0.8e-3))
        u = grid.point_fields["displacement"][on_crack]
        x = grid.points[on_crack, 0]
        for place in np.unique(x.round(9)):
            here = u[np.abs(x - place) < 1e-9, 1]
            self.assertGreater(np.ptp(here), 1e-8)
        behind = run.opening["opening"]
        self.assertAlmostEqual(np.ptp(u[:, 1]) / behind.max(), 1.0, delta=0.1)
        self.assertTrue(np.all(behind > 0))
        # Close to the tip the faces follow the law.
        near = run.opening["distance"] < 2e-6
        np.testing.assert_allclose(
            behind[near], run.opening["asymptotic_opening"][near], rtol=0.01)
        # So does the stress.
        ahead = run.tip_stress["angle"] == 0
        first = np.argmin(run.tip_stress["radius"] + 1.0 * ~ahead)
        self.assertAlmostEqual(run.tip_stress["stress_tt"][first]
                               / run.tip_stress["asymptotic_tt"][first], 1.0,
                               delta=0.02)
        self.assertEqual(set(np.unique(run.nodes.point_fields["kind"]))
                         - {1.0, 2.0, 3.0}, set())

    @unittest.skipUnless(MORSEL, "MORSEL does not name the program")
    def test_run_of_two_cracks(self):
        run = self.run_scene("two_cracks.prm", "--set", "Name=pair")
        self.assertEqual([t.suffix(run.tips) for t in run.tips],
                         ["", "_crack1_tip0"])
        self.report()
        self.assertIn("tip_field", self.figures())

    @unittest.skipUnless(MORSEL, "MORSEL does not name the program")
    def test_former_pieces_do_not_stay(self):
        solution = self.folder / "solution"
        write_squares(solution, ranks=3)
        (solution / "plate_of_mine.vtu").write_text("mine")
        self.run_scene("m1_xfem.prm")
        self.assertEqual(
            sorted(f.name for f in solution.glob("plate*")),
            ["plate.pvd", "plate.vtu", "plate_of_mine.vtu"])


if __name__ == "__main__":
    unittest.main()
