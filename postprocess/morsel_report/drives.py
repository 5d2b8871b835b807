"""How plates moved that the food slows, or that move by more than a constant
speed."""
import matplotlib.pyplot as plt
import numpy as np

from . import style
from .curves import PLATE_COLOURS, plate_label

PREFIX = "closing_speed_"


def moving_plates(run):
    """Names of the plates whose speed the history holds."""
    return [n[len(PREFIX):] for n in run.history if n.startswith(PREFIX)]


def closing(run):
    """Force and closing speed over time: what the food does to the jaw."""
    t, names = run.column("time"), moving_plates(run)
    if t is None or not names or len(t) < 2:
        return None
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(6.2, 5.0), sharex=True, layout="constrained")
    force = run.mean_force()
    factor, unit = style.prefix_of(max(np.max(np.abs(force)), 1e-30), "N")
    above.plot(time_factor * t, factor * force, color=style.INK)
    above.set_ylabel(f"Mean force [{unit}]")
    above.set_ylim(bottom=0.0)
    top = max(np.max(np.abs(run.column(PREFIX + n))) for n in names)
    factor, unit = style.prefix_of(max(top, 1e-30), "m/s")
    for k, name in enumerate(names):
        below.plot(time_factor * t, factor * run.column(PREFIX + name),
                   color=PLATE_COLOURS[k % len(PLATE_COLOURS)],
                   label=plate_label(name))
    below.axhline(0.0, color=style.INK, lw=0.6)
    below.set_ylabel(f"Closing speed [{unit}]")
    below.set_xlabel(f"Time [{time_unit}]")
    below.set_xlim(0, time_factor * t.max())
    if len(names) > 1:
        below.legend(loc="best")
    return figure


def muscles(run):
    """Moment of the muscles, and where their work goes."""
    t, moment = run.column("time"), run.column("muscle_moment")
    if t is None or moment is None or len(t) < 2:
        return None
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(6.2, 5.0), sharex=True, layout="constrained")
    above.plot(time_factor * t, moment, color=style.RED)
    above.set_ylabel("Moment of the muscles [N m]")
    above.set_ylim(bottom=min(0.0, float(np.min(moment))))
    work, kinetic = run.column("muscle_work"), run.column("jaw_kinetic_energy")
    passed = run.column("external_work")
    curves = [(work, "work of the muscles", style.RED, "-"),
              (kinetic, "kinetic energy of the jaw", style.GREEN, "-"),
              (passed, "work of all teeth on the food", style.BLUE, (0, (5, 2)))]
    largest = max(np.max(np.abs(c[0])) for c in curves if c[0] is not None)
    factor, unit = style.prefix_of(max(largest, 1e-30), "J")
    for values, label, colour, line in curves:
        if values is not None:
            below.plot(time_factor * t, factor * values, color=colour,
                       label=label, ls=line)
    below.set_ylabel(f"Energy [{unit}]")
    below.set_xlabel(f"Time [{time_unit}]")
    below.set_xlim(0, time_factor * t.max())
    below.legend(loc="best")
    return figure
