"""What the page tells of an experiment on particle bodies without plates."""
import html

import matplotlib.pyplot as plt
import numpy as np

from . import curves, food, style
from .tables import warnings_of  # noqa: F401 (part of every story)

KICKER = "MORSEL · an experiment on particle bodies"


def moments(run):
    """The body at the first, some middle and the last frame, by stress."""
    frames, _ = run.food()
    if not frames or frames[0].points() is None:
        return None
    spacing = 1e3 * food.spacing_of(frames[0].points())
    # Tall bodies leave room for more.
    x, y = np.ptp(frames[0].points()[:, :2], axis=0)
    count = 5 if y > 1.2 * x else 3
    places = sorted({k * (len(frames) - 1) // (count - 1)
                     for k in range(count)})
    chosen = [("", frames[k]) for k in places]
    view = food.extent_of([frame for _, frame in chosen])
    aspect = (view[1][1] - view[0][1]) / (view[1][0] - view[0][0])
    rows = [(field, label, cmap) for field, label, cmap in (
        ("damage", "Damage", style.DAMAGE),
        ("von_mises", "Von Mises stress", style.STRESS),
        ("stress_yy", "Stress along y", "RdBu"))
        if frames[-1].read(field) is not None][:2]
    if not rows:
        return None
    width = 9.6 / (len(chosen) + 0.35)
    # Flat bodies leave the colour bars room for their names.
    height = max(width * aspect, 1.9)
    figure, grid = plt.subplots(
        len(rows), len(chosen), squeeze=False, layout="constrained",
        figsize=(9.6, len(rows) * height + 0.75))
    for r, (field, label, cmap) in enumerate(rows):
        food.draw_row(figure, grid[r], run, chosen, field, label, cmap,
                      spacing, view)
    for axes, (_, frame) in zip(grid[0], chosen):
        axes.set_title(style.quantity(frame.time, "s", 3), fontsize=9.5)
    food.scale_bar(grid[-1][0], view)
    return figure


def over_time(run, prefix, unit, label, but=None):
    """All columns of the history that begin so, over time; None without.

    Those that begin with `but` are left out."""
    t = run.column("time")
    names = [n for n in run.history if n.startswith(prefix)
             and not (but and n.startswith(but))
             and np.ptp(run.column(n)) > 0]
    if t is None or len(t) < 2 or not names:
        return None
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    top = max(np.max(np.abs(run.column(n))) for n in names)
    shown = [n for n in names
             if np.max(np.abs(run.column(n))) > 1e-6 * top]
    factor, unit = style.prefix_of(top, unit)
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    for k, name in enumerate(shown):
        axes.plot(time_factor * t, factor * run.column(name), lw=1.2,
                  color=style.FRAGMENTS[k % len(style.FRAGMENTS)],
                  label=name[len(prefix):].replace("_", " "))
    axes.set_xlim(0, time_factor * t.max())
    axes.set_xlabel(f"Time [{time_unit}]")
    axes.set_ylabel(f"{label} [{unit}]")
    axes.legend(fontsize=8)
    return figure


def stress_intensities(run):
    """K of the bodies' cracks over time, what is expected of them dotted."""
    figure = over_time(run, "stress_intensity_", "Pa sqrt(m)",
                       "Stress intensity factor")
    if figure is None:
        return None
    expected = {entry["reference"] for name, entry in run.results().items()
                if name.startswith("stress_intensity_")
                and entry.get("reference") is not None}
    for value in expected:
        figure.axes[0].axhline(value, color=style.QUIET, lw=0.9, ls=":")
    return figure


def load(run):
    """What breaks the body over the way it has come, or over time."""
    force, t = run.column("load"), run.column("time")
    way = run.column("load_displacement")
    if force is None or len(t) < 2 or not np.ptp(force) > 0:
        return None
    x, unit, label = ((way, "m", "Displacement of the load")
                      if way is not None and np.ptp(way) > 0
                      else (t, "s", "Time"))
    x_factor, x_unit = style.prefix_of(x.max(), unit)
    factor, unit = style.prefix_of(np.max(np.abs(force)), "N")
    figure, axes = plt.subplots(figsize=(6.2, 3.7), layout="constrained")
    axes.plot(x_factor * x, factor * force, color=style.BLUE)
    at = run.value("first_failure_time")
    if at is not None:
        axes.plot(x_factor * np.interp(at, t, x),
                  factor * np.interp(at, t, force), "o", ms=5, zorder=5,
                  color=style.RED, label="the first particle fails")
        axes.legend(fontsize=8)
    axes.set_xlim(0, x_factor * x.max())
    axes.set_xlabel(f"{label} [{x_unit}]")
    axes.set_ylabel(f"Load [{unit}]")
    return figure


def crack_growth(run):
    """How far and how fast cracks have grown from their tips."""
    t = run.column("time")
    prefix = "crack_extension"
    tips = [n[len(prefix):] for n in run.history if n.startswith(prefix)
            and run.column(n).max() > 0]
    if t is None or not tips:
        return None
    time_factor, time_unit = style.prefix_of(t.max(), "s")
    factor, unit = style.prefix_of(
        max(run.column(prefix + tip).max() for tip in tips), "m")
    figure, (far, fast) = plt.subplots(
        1, 2, figsize=(9.6, 3.4), layout="constrained")
    for k, tip in enumerate(tips):
        colour = style.FRAGMENTS[k % len(style.FRAGMENTS)]
        far.plot(time_factor * t, factor * run.column(prefix + tip),
                 color=colour, label=tip[1:].replace("_", " "))
        fast.plot(time_factor * t, run.column("crack_tip_speed" + tip),
                  color=colour)
    limit = run.value("rayleigh_speed")
    if limit is not None:
        fast.axhline(0.6 * limit, color=style.QUIET, lw=0.9, ls=":")
        fast.annotate("0.6 of the Rayleigh speed", (0.02, 0.6 * limit),
                      xycoords=("axes fraction", "data"), fontsize=8,
                      xytext=(0, 3), textcoords="offset points")
    for axes in (far, fast):
        axes.set_xlim(0, time_factor * t.max())
        axes.set_ylim(bottom=0)
        axes.set_xlabel(f"Time [{time_unit}]")
    far.set_ylabel(f"Growth of the crack [{unit}]")
    fast.set_ylabel("Speed of its tip [m/s]")
    if len(tips) > 1:
        far.legend(fontsize=8)
    return figure


def stress_errors(run):
    """{observed point: largest error of its stress}, where one is known."""
    errors = {}
    for name, entry in run.results().items():
        parts = name.split("_", 2)
        if (parts[0] == "stress" and "error" in entry and len(parts) == 3
                and parts[1] != "intensity"):
            point = parts[2].replace("_", " ")
            errors[point] = max(errors.get(point, 0.0), abs(entry["error"]))
    return errors


def errors_by_point(run):
    """The largest error of the stress at each observed point."""
    errors = stress_errors(run)
    if len(errors) < 3:
        return None
    figure, axes = plt.subplots(figsize=(7.4, 0.28 * len(errors) + 1.1),
                                layout="constrained")
    for i, (point, error) in enumerate(errors.items()):
        error = max(100 * error, 1e-12)
        axes.plot(error, i, "o", ms=6,
                  color=style.RED if error > 1 else style.GREEN)
        axes.annotate(style.digits(error, 2), (error, i), fontsize=8,
                      xytext=(8, 0), textcoords="offset points", va="center")
    axes.set_xscale("log")
    axes.margins(x=0.16)
    axes.axvline(1, color=style.QUIET, lw=0.8, ls=":")
    axes.set_yticks(range(len(errors)), list(errors))
    axes.invert_yaxis()
    axes.set_xlabel("Largest error of a stress component [% of the largest]")
    return figure


FIGURES = [
    ("moments", moments,
     "The body at the beginning, in between and at the end: the von Mises "
     "stress, above it the damage or below it the stress along y.", True),
    ("fragments", food.fragments,
     "The pieces that are left, each in its own colour and numbered by size; "
     "light grey is what has failed altogether.", True),
    ("load", load, "What breaks the body: the mean force of the conditions "
     "that move, or load, it.", False),
    ("crack_growth", crack_growth,
     "How far the cracks have grown, and how fast: means over ten particle "
     "spacings.", True),
    ("displacements",
     lambda run: over_time(run, "displacement_", "m", "Displacement"),
     "Displacement of the observed points over time.", False),
    ("stresses", lambda run: over_time(run, "stress_", "Pa", "Stress",
                                       but="stress_intensity_"),
     "Stress at the observed points over time.", False),
    ("errors", errors_by_point,
     "Errors of the stress at the end where it is known: red above 1\u202f%.",
     False),
    ("stress_intensities", stress_intensities,
     "Stress intensity factors of the bodies' cracks over time, by the "
     "interaction integral; dotted: what is expected of them.", False),
    ("forces", lambda run: over_time(run, "force_", "N", "Force"),
     "Force of supports and loads over time.", False),
    ("energy", curves.energy_ledger,
     "Where the external work goes: blue and green is stored, warm colours "
     "are spent. What separates the stack from the black line is the closing "
     "error, shown below.", True),
]

SECTIONS = [
    ("The body", ["moments", "fragments"]),
    ("How it breaks", ["load", "crack_growth"]),
    ("Observed points, supports and loads",
     ["displacements", "stresses", "errors", "stress_intensities", "forces"]),
    ("The energy ledger", ["energy"]),
]

CARDS = [
    ("peak_load", "largest load"),
    ("fragment_count", "pieces"),
    ("crack_tip_speed_over_rayleigh",
     "largest speed of the crack over the Rayleigh speed"),
    ("strain_energy", "strain energy at the end"),
    ("energy_balance_error", "closing error of the energy ledger"),
    ("momentum_error", "error of linear momentum"),
    ("minimum_spacing", "smallest distance of two particles over the initial "
                        "spacing"),
]


def outcome(run):
    """What happened, in a sentence."""
    given = run.text("outcome")
    if given:
        return given
    count, steps = run.value("particle_count"), run.value("step_count")
    time, end = run.value("simulated_time"), run.text("ended_by")
    if None in (count, steps, time):
        return ""
    text = (f"{int(count)} particles over {style.quantity(time, 's', 3)} in "
            f"{int(steps)} steps")
    return text + (f"; ended by: {end}." if end else ".")


def tables(run):
    """Errors of strain rates by body and place (figure 3-9), if asked for."""
    prefix = "strain_rate_error_"
    errors = {}
    for name, entry in run.results().items():
        if name.startswith(prefix):
            place, body = name[len(prefix):].split("_", 1)
            errors.setdefault(body.replace("_", " "), {})[place] = (
                entry["value"])
    if not errors:
        return []
    rows = "".join(
        f"<tr><td>{html.escape(body)}</td>" + "".join(
            f'<td class="n">{found.get(place, float("nan")):.3g}</td>'
            for place in ("interior", "edge", "corner")) + "</tr>"
        for body, found in errors.items())
    return ["<h2>Errors of the strain rate</h2><table><thead><tr>"
            '<th>Body</th><th class="n">Interior [1/s]</th>'
            '<th class="n">Edge [1/s]</th><th class="n">Corner [1/s]</th>'
            f"</tr></thead><tbody>{rows}</tbody></table>"]
