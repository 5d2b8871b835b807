#!/usr/bin/python3
"""Draws the smoothing kernels with their derivatives (figures 3-7 and 3-8 of
the thesis) and where Swegle's condition W'' sigma > 0 (T3-32) makes tension or
compression unstable.

    postprocess/kernels.py [FILE.png]

The report of the study prm/sph/kernels.prm has this figure, too, and beside it
what runs measured.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from morsel_report import kernels  # noqa: E402 (it needs the path)


def main():
    """Writes the figure."""
    target = sys.argv[1] if len(sys.argv) > 1 else "kernels.png"
    kernels.figure_of_kernels().savefig(target)
    print(target)


if __name__ == "__main__":
    main()
