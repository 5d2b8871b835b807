"""The report on bodies in static equilibrium, from a run of the program.

The program is run where the environment's MORSEL names it.
"""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "postprocess"))

import report
from morsel_report import reader

SCENE = HERE.parent.parent / "prm" / "sph" / "lame_cylinder.prm"
MORSEL = os.environ.get("MORSEL", "")


@unittest.skipUnless(MORSEL, "MORSEL names no program")
class StaticReport(unittest.TestCase):
    """One small ring."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name) / "ring"
        subprocess.run(
            [MORSEL, str(SCENE), "--output", str(self.folder), "--quiet",
             "--set", "Body ring/Particles/Particles across=12"],
            check=True, stdout=subprocess.DEVNULL)

    def test_cells_and_outline_are_read(self):
        run = reader.Run(self.folder)
        self.assertTrue(run.is_static())
        cells, outline = run.static_bodies["ring"]
        self.assertEqual(len(cells.offsets), run.value("particle_count"))
        self.assertEqual(len(outline.offsets), 1)
        self.assertEqual(run.notes, [])

    def test_page_shows_what_is_known(self):
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(self.folder)]), 0)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("Against what is known", page)
        self.assertIn("particles in equilibrium after", page)
        for name in ("deformed", "stresses", "filling"):
            self.assertTrue((self.folder / "figures" / f"{name}.png")
                            .is_file())
        self.assertNotIn("could not be drawn", page)


if __name__ == "__main__":
    unittest.main()
