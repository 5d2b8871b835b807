#!/usr/bin/env python3
"""Draws the smoothing kernels with their derivatives (figures 3-7 and 3-8 of
the thesis) and where Swegle's condition W'' sigma > 0 (T3-32) makes tension or
compression unstable.

    postprocess/kernels.py [FILE.png]

The formulas are those of include/morsel/core/kernel.h, for h = 1 in the plane.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def positive(x, power):
    return np.maximum(x, 0.0) ** power


def cubic(q):
    return 15 / (7 * np.pi) * np.where(
        q < 1, 2 / 3 - q**2 + q**3 / 2, positive(2 - q, 3) / 6)


def quadratic(q):
    return 1 / np.pi * np.where(q < 2, 3 / 8 * (2 - q) ** 2, 0)


def wendland_c2(q):
    return 7 / (4 * np.pi) * positive(1 - q / 2, 4) * (1 + 2 * q)


def quintic(q):
    return 7 / (478 * np.pi) * (
        positive(3 - q, 5) - 6 * positive(2 - q, 5) + 15 * positive(1 - q, 5))


KERNELS = {
    "cubic B-spline (T3-33)": cubic,
    "quadratic (T3-34)": quadratic,
    "Wendland C2": wendland_c2,
    "quintic spline": quintic,
}


def main():
    target = sys.argv[1] if len(sys.argv) > 1 else "kernels.png"
    q = np.linspace(1e-3, 3, 1500)
    step = 1e-4
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), sharex=True)
    for axis, (name, kernel) in zip(axes.flat, KERNELS.items()):
        slope = (kernel(q + step) - kernel(q - step)) / (2 * step)
        bend = (kernel(q + step) - 2 * kernel(q) + kernel(q - step)) / step**2
        # The quadratic kernel's W'' jumps at the end of the support.
        bend = np.clip(bend, -4, 4)
        axis.plot(q, kernel(q), label="W")
        axis.plot(q, slope, label="W'")
        axis.plot(q, bend, label="W''")
        low, high = axis.get_ylim()
        axis.fill_between(q, low, high, where=bend > 1e-6, alpha=0.12,
                          color="tab:red", label="tension unstable")
        axis.fill_between(q, low, high, where=bend < -1e-6, alpha=0.12,
                          color="tab:blue", label="compression unstable")
        axis.axvline(1 / 1.3, color="0.5", linestyle=":",
                     label="nearest neighbour at h = 1.3 dp")
        axis.axhline(0, color="0.5", linewidth=0.5)
        axis.set_ylim(low, high)
        axis.set_title(name)
        axis.set_xlabel("q = r/h [1]")
        axis.set_ylabel("W [1/h^2], W' [1/h^3], W'' [1/h^4]")
    axes.flat[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(target, dpi=130)
    print(target)


if __name__ == "__main__":
    main()
