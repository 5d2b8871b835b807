"""The report on a breaking experiment, from a run of the program.

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

SCENES = HERE.parent.parent / "prm" / "breaking"
MORSEL = os.environ.get("MORSEL", "")


@unittest.skipUnless(MORSEL, "MORSEL names no program")
class BreakingReport(unittest.TestCase):
    """Coarse forms of shipped scenes."""

    def figures_of(self, scene, *entries):
        """The page and the names of its figures."""
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        folder = pathlib.Path(temporary.name) / "run"
        subprocess.run(
            [MORSEL, str(SCENES / scene), "--output", str(folder), "--quiet"]
            + [part for entry in entries for part in ("--set", entry)],
            check=True, stdout=subprocess.DEVNULL)
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main([str(folder)]), 0)
        page = (folder / "report.html").read_text(encoding="utf-8")
        return page, {f.stem for f in (folder / "figures").glob("*.png")}

    def test_bar(self):
        page, figures = self.figures_of(
            "tension_bar.prm", "Output/Field frames=6",
            "Body bar/Particles/Particles across=5")
        self.assertLessEqual({"moments", "fragments", "load", "energy"},
                             figures)
        self.assertNotIn("crack_growth", figures)
        self.assertIn("largest load", page)

    def test_crack(self):
        page, figures = self.figures_of(
            "branching.prm", "Output/Field frames=4",
            "Body plate/Particles/Particles across=60")
        self.assertLessEqual({"moments", "crack_growth"}, figures)
        self.assertIn("Rayleigh speed", page)


if __name__ == "__main__":
    unittest.main()
