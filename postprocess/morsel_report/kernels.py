"""Smoothing kernels, Swegle's condition, and the stability of a lattice.

The kernels are those of include/morsel/core/kernel.h, for h = 1 in the plane.
"""
import matplotlib.pyplot as plt
import numpy as np

from . import style


def positive(x, power):
    """x^power where x is positive, else 0."""
    return np.maximum(x, 0.0) ** power


def cubic(q):
    """The cubic B-spline (T3-33)."""
    return 15 / (7 * np.pi) * np.where(
        q < 1, 2 / 3 - q**2 + q**3 / 2, positive(2 - q, 3) / 6)


def quadratic(q):
    """The quadratic kernel (T3-34)."""
    return 3 / (8 * np.pi) * positive(2 - q, 2)


def wendland_c2(q):
    """Wendland's function of smoothness 2."""
    return 7 / (4 * np.pi) * positive(1 - q / 2, 4) * (1 + 2 * q)


def quintic(q):
    """The quintic spline (Morris 1996), of support 3 h."""
    return 7 / (478 * np.pi) * (
        positive(3 - q, 5) - 6 * positive(2 - q, 5) + 15 * positive(1 - q, 5))


KERNELS = {
    "cubic B-spline": cubic,
    "quadratic": quadratic,
    "Wendland C2": wendland_c2,
    "quintic spline": quintic,
}
STEP = 1e-4


def slope(kernel, q):
    """W'(q)."""
    return (kernel(q + STEP) - kernel(q - STEP)) / (2 * STEP)


def bend(kernel, q):
    """W''(q), from within where the quadratic kernel's jumps to 0."""
    q = np.where(np.abs(q - 2) < 2 * STEP, 2 - 2 * STEP, q)
    return (kernel(q + STEP) - 2 * kernel(q) + kernel(q - STEP)) / STEP**2


def figure_of_kernels():
    """W, W' and W'' of all kernels, and where T3-32 holds."""
    q = np.linspace(1e-3, 3, 1501)
    figure, grid = plt.subplots(2, 2, figsize=(9.6, 6.8), sharex=True,
                                layout="constrained")
    for axes, (name, kernel) in zip(grid.flat, KERNELS.items()):
        curvature = bend(kernel, q)
        for values, label, colour in (
                (kernel(q), "$W$", style.BLUE),
                (slope(kernel, q), "$W'$", style.ORANGE),
                (curvature, "$W''$", style.GREEN)):
            axes.plot(q, values, label=label, color=colour)
        low, high = axes.get_ylim()
        for where, label, colour in (
                (curvature > 1e-6, "tension unstable", style.RED),
                (curvature < -1e-6, "compression unstable", style.SKY)):
            axes.fill_between(q, low, high, where=where, alpha=0.15, lw=0,
                              color=colour, label=label)
        axes.axvline(1 / 1.3, color="0.4", ls=":",
                     label="nearest neighbour, h = 1.3 dp")
        axes.set_xlim(0, 3)
        axes.set_ylim(low, high)
        axes.set_title(name)
    for axes in grid[1]:
        axes.set_xlabel("$q = r/h$")
    for axes in grid[:, 0]:
        axes.set_ylabel("$W\\ [1/h^2],\\ W'\\ [1/h^3],\\ W''\\ [1/h^4]$")
    grid[0][0].legend(fontsize=8)
    return figure


def growth_rate(kernel, ratio, stress, poissons_ratio=0.3, rows=66):
    """The largest growth rate of a plane wave on a lattice under a stress
    along y, by linear theory of the classical updated Lagrangian equations
    (T3-22 to T3-26 with the Jaumann rate), in sqrt(|stress| / rho) / dp.

    ratio is h/dp, stress is in units of Young's modulus, rows is how many
    rows and columns are free to move: it sets the waves that there are, and
    the longest of them are held by elasticity.
    """
    reach = int(np.ceil(3 * ratio))
    x = np.array([(i, j) for i in range(-reach, reach + 1)
                  for j in range(-reach, reach + 1) if (i, j) != (0, 0)],
                 dtype=float)
    r = np.hypot(*x.T)
    normal = x / r[:, None]
    first = slope(kernel, r / ratio) / ratio**3
    second = bend(kernel, r / ratio) / ratio**4
    along = np.einsum("na,nb->nab", normal, normal)
    hessian = (second[:, None, None] * along
               + (first / r)[:, None, None] * (np.eye(2) - along))
    k = np.pi * np.arange(rows + 1) / (rows + 1)
    k = np.array(np.meshgrid(k, k)).reshape(2, -1).T[1:]
    phase = k @ x.T
    wave = -np.sin(phase) @ (first[:, None] * normal)
    geometric = np.einsum("kn,nab->kab", 1 - np.cos(phase), hessian)
    nu = poissons_ratio
    lame = nu / ((1 + nu) * (1 - 2 * nu))
    shear = 0.5 / (1 + nu)
    prestress = np.diag([0.0, stress])
    matrix = np.empty((len(k), 2, 2))
    for d in range(2):
        u = np.eye(2)[d]
        gradient = np.einsum("a,kb->kab", u, wave)
        strain = 0.5 * (gradient + gradient.transpose(0, 2, 1))
        spin = gradient - strain
        trace = np.trace(strain, axis1=1, axis2=2)
        rate = (lame * trace[:, None, None] * np.eye(2) + 2 * shear * strain
                + spin @ prestress - prestress @ spin)
        # The stress, the neighbours' volumes, and the kernel's gradient.
        matrix[:, :, d] = (-np.einsum("kab,kb->ka", rate, wave)
                           - 2 * trace[:, None] * (wave @ prestress)
                           + 2 * (geometric @ u) @ prestress)
    largest = np.linalg.eigvals(matrix).real.max()
    return np.sqrt(max(largest, 0.0) / abs(stress))


def is_stability_study(study):
    """Whether the runs vary kernel, smoothing ratio and stress."""
    return {"kernel", "ratio", "stress"} <= set(study.axes)


def stability_map(study, quantity):
    """Measured growth over smoothing ratio and stress, above what linear
    theory says; None for other studies."""
    runs = [r for r in study.runs
            if r["quantities"][quantity]["value"] is not None]
    if not is_stability_study(study) or not runs:
        return None
    names = [n for n in KERNELS if n in {r["axes"]["kernel"] for r in runs}]
    ratios = sorted({r["axes"]["ratio"] for r in runs})
    stresses = sorted({r["axes"]["stress"] for r in runs})
    figure, grid = plt.subplots(
        2, len(names), sharex=True, sharey=True, squeeze=False,
        figsize=(2.9 * len(names) + 1, 6.4), layout="constrained")
    for c, name in enumerate(names):
        measured = np.full((len(stresses), len(ratios)), np.nan)
        for r in runs:
            if r["axes"]["kernel"] == name:
                measured[stresses.index(r["axes"]["stress"]),
                         ratios.index(r["axes"]["ratio"])] = (
                             r["quantities"][quantity]["value"])
        theory = np.array([[growth_rate(KERNELS[name], ratio, stress)
                            for ratio in ratios] for stress in stresses])
        for axes, values in zip(grid[:, c], (measured, theory)):
            shown = draw_cells(axes, values, name, ratios, stresses)
    for axes, label in zip(grid[:, 0], ("Measured", "Linear theory")):
        axes.set_yticks(range(len(stresses)),
                        [style.digits(s, 1) for s in stresses])
        axes.set_ylabel(f"{label}: stress over E")
    for axes in grid[1]:
        axes.set_xticks(range(len(ratios)), [f"{r:g}" for r in ratios])
        axes.set_xlabel("h/dp")
    for axes, name in zip(grid[0], names):
        axes.set_title(name)
    figure.colorbar(shown, ax=grid, shrink=0.7,
                    label="Growth rate over $\\omega_0$")
    return figure


def draw_cells(axes, values, name, ratios, stresses):
    """Cells with their numbers; framed where T3-32 calls them unstable."""
    shown = axes.imshow(values, origin="lower", aspect="auto", vmin=0,
                        vmax=2, cmap="YlOrRd")
    axes.grid(False)
    for i, stress in enumerate(stresses):
        for j, ratio in enumerate(ratios):
            if np.isfinite(values[i, j]):
                axes.text(j, i, f"{values[i, j]:.1f}".replace("-0.0", "0.0"),
                          ha="center", va="center", fontsize=7,
                          color="white" if values[i, j] > 1.3 else style.INK)
            if bend(KERNELS[name], np.array([1 / ratio]))[0] * stress > 0:
                axes.add_patch(plt.Rectangle(
                    (j - 0.5, i - 0.5), 1, 1, fill=False, hatch="///",
                    ec="#00000055", lw=0))
    return shown
