"""How one result of a study goes with another: points, lines, correlations."""
import html
import math

import matplotlib.pyplot as plt
import numpy as np

from . import labels, style
from .study_data import axis_label, in_figure, in_page, look, plain_ticks
from .study_tables import table

# Points over a wider range than this many decades are drawn over logarithms.
WIDEST_LINEAR = 1.5
# More points than these are not labelled: nobody could tell them apart.
MOST_LABELLED = 30
RANGE = "{:.2f} … {:.2f}"


def signed(text):
    """A number's text with a minus sign."""
    return text.replace("-", "−")


def probability(p):
    """A p-value."""
    if p is None:
        return "–"
    return "< 0.001" if p < 0.001 else f"{p:.2g}"


def correlation(group):
    """"−0.86 (−0.95 … −0.62)" of a group, "–" where unknown."""
    r, low, high = (group.get("correlation" + k) for k in ("", "_low", "_high"))
    if r is None:
        return "–"
    return signed(f"{r:.2f}" + (f" ({RANGE.format(low, high)})"
                                if None not in (low, high) else ""))


def expected(relation):
    """"r = −0.86 (Agrawal et al. 1997, 28 points)"; empty without."""
    r = relation.get("expected_correlation")
    if r is None:
        return ""
    number = relation.get("expected_points")
    origin = [relation.get("source"), f"{number} points" if number else ""]
    origin = ", ".join(o for o in origin if o)
    return signed(f"r = {r:g}") + (f" ({origin})" if origin else "")


def groups_of(relation):
    """The groups that have points, each with arrays of x and y."""
    return [(g, np.array([p["x"] for p in g["points"]], float),
             np.array([p["y"] for p in g["points"]], float))
            for g in relation["groups"] if g["points"]]


def is_wide(groups):
    """Whether x is best drawn over logarithms."""
    x = np.concatenate([x for _, x, _ in groups])
    return x.min() > 0 and math.log10(x.max() / x.min()) > WIDEST_LINEAR


def scales(study, relation, groups):
    """(factor, unit) of x and of y."""
    return [style.prefix_of(float(np.median(np.abs(np.concatenate(
        [g[i] for g in groups])))), study.unit_of(relation[name]))
            for i, name in ((1, "x"), (2, "y"))]


def deviations(group, name, factor):
    """The error bars of a group's points, or None."""
    found = [factor * (p.get(name + "_deviation") or 0.0)
             for p in group["points"]]
    return found if any(found) else None


def bars(group, x, y, factors):
    """Points along the error bars of a group, which labels have to avoid."""
    along = np.linspace(-1, 1, 21)[:, None]
    shifts = [np.array(deviations(group, name, f) or 0.0)
              for name, f in zip("xy", factors)]
    x, y = factors[0] * x, factors[1] * y
    return np.concatenate([
        np.stack(np.broadcast_arrays(x + along * shifts[0], y), -1),
        np.stack(np.broadcast_arrays(x, y + along * shifts[1]), -1)],
        axis=0).reshape(-1, 2)


def half_band(group, x, at):
    """Half the width of the 95 % band of the mean; None without interval.

    It is half the slope's interval times sqrt(Sxx / n + (x - mean)^2): both
    hold the same quantile of Student's t.
    """
    if group.get("slope_low") is None:
        return None
    return 0.5 * (group["slope_high"] - group["slope_low"]) * np.sqrt(
        np.var(x) + (at - x.mean()) ** 2)


def beyond(groups, group, x):
    """Whether a group's band is wider than all that was found."""
    half = half_band(group, x, x)
    span = np.ptp(np.concatenate([y for _, _, y in groups]))
    deviation = max((p.get("y_deviation") or 0.0 for g, _, _ in groups
                     for p in g["points"]), default=0.0)
    return half is not None and half.min() > span + deviation


def draw_line(axes, group, x, factors, wide, look_of):
    """The regression line, with its band; where the line runs."""
    if group.get("slope") is None or np.ptp(x) == 0:
        return np.empty((0, 2))
    at = (np.geomspace if wide else np.linspace)(x.min(), x.max(), 300)
    line = factors[1] * (group["intercept"] + group["slope"] * at)
    colour, with_band = look_of
    axes.plot(factors[0] * at, line, color=colour, lw=1.3)
    half = half_band(group, x, at)
    if half is not None and with_band:
        axes.fill_between(factors[0] * at, line - factors[1] * half,
                          line + factors[1] * half, color=colour, alpha=0.13,
                          lw=0)
    return np.stack([factors[0] * at, line], axis=1)


def draw_labels(axes, groups, factors, lines, colours):
    """Names the points; what several series share at one x is named once."""
    points, texts, inks, named = [], [], [], set()
    order = [(p["x"], p["y"], str(p.get("label") or ""), colour)
             for (group, _, _), colour in zip(groups, colours)
             for p in group["points"]]
    for x, y, name, colour in sorted(order, key=lambda o: -o[1]):
        if name and (name, f"{x:.3g}") not in named:
            named.add((name, f"{x:.3g}"))
            points.append((factors[0] * x, factors[1] * y))
            texts.append(in_figure(name))
            inks.append(colour if len(groups) > 1 else style.INK)
    if 0 < len(points) <= MOST_LABELLED:
        labels.place(axes, points, texts, inks, np.concatenate(lines))


def relation_figure(study, relation):
    """Points with the deviations of draws, regression lines with bands."""
    groups = groups_of(relation)
    if not groups:
        return None
    wide = is_wide(groups)
    (fx, unit_x), (fy, unit_y) = scales(study, relation, groups)
    figure, axes = plt.subplots(figsize=(7.4, 5.2), layout="constrained")
    lines, colours = [], []
    for k, (group, x, y) in enumerate(groups):
        form = look(k)
        colours.append(form["color"])
        title = (study.title_of(group["series"]) + ": "
                 if len(study.series) > 1 else "")
        axes.errorbar(
            fx * x, fy * y, xerr=deviations(group, "x", fx),
            yerr=deviations(group, "y", fy), ls="none", ms=6, elinewidth=0.9,
            capsize=2.5, zorder=3, **form,
            label=f"{title}r = {correlation(group)}, {len(x)} points")
    low, high = axes.get_ylim()
    if wide:
        axes.set_xscale("log")
    for (group, x, y), colour in zip(groups, colours):
        lines += [draw_line(axes, group, x, (fx, fy), wide,
                            (colour, not beyond(groups, group, x))),
                  bars(group, x, y, (fx, fy))]
    # Bands of few points may be far wider than what was found.
    axes.set_ylim(low - 0.12 * (high - low), high + 0.12 * (high - low))
    axes.margins(x=0.12)
    if wide:
        plain_ticks(axes.xaxis, fx * np.concatenate([x for _, x, _ in groups]))
    axes.set_xlabel(axis_label(in_figure(study.label_of(relation["x"])),
                               unit_x))
    axes.set_ylabel(axis_label(in_figure(study.label_of(relation["y"])),
                               unit_y))
    handles, names = axes.get_legend_handles_labels()
    if expected(relation):
        handles.append(plt.Line2D([], [], ls="none"))
        names.append("published: " + expected(relation))
    style.legend_above(figure, handles, names, 1)
    draw_labels(axes, groups, (fx, fy), lines, colours)
    return figure


def relation_caption(study, relation):
    """What the figure of a relation shows."""
    groups = groups_of(relation)
    text = ("Lines: least squares of each series, in the band with 95\u202f% "
            "confidence.")
    if any(deviations(g, name, 1.0) for g, _, _ in groups for name in "xy"):
        text = ("Means over the draws, with their standard deviations. "
                + text)
    if any(beyond(groups, group, x) for group, x, _ in groups):
        text += (" A band that would be wider than the figure is left out: "
                 "so few points do not tell the line.")
    if expected(relation):
        text += f" Published: {expected(relation)}."
    if groups and is_wide(groups):
        text += (" They are straight; over the logarithmic axis they look "
                 "bent.")
    return text


def relation_tables(study, relation):
    """Correlations, slopes, and how they compare; HTML."""
    groups = groups_of(relation)
    if not groups:
        return ""
    (fx, unit_x), (fy, unit_y) = scales(study, relation, groups)
    factor = fy / fx
    unit = style.pretty_unit(unit_y) or "1"
    if style.pretty_unit(unit_x):
        unit += " per " + style.pretty_unit(unit_x)

    def number(value):
        return "–" if value is None else style.digits(factor * value, 3)

    against = expected(relation)
    head = ["Series", "Points", "r (95\u202f%)", "p", f"Slope [{unit}]",
            "95\u202f%"] + (["p against published r"] if against else [])
    rows = [[html.escape(study.title_of(g["series"])), len(x), correlation(g),
             probability(g.get("p_value")), number(g.get("slope")),
             "–" if g.get("slope_low") is None else
             f"{number(g['slope_low'])} … {number(g['slope_high'])}"]
            + ([probability(g.get("expected_p_value"))] if against else [])
            for g, x, _ in groups]
    text = table(head, rows)
    if relation.get("slopes"):
        text += table(
            ["Slopes compared", f"Difference [{unit}]", "p"],
            [[html.escape(f"{study.title_of(s['first'])} and "
                          f"{study.title_of(s['second'])}"),
              number(s.get("difference")), probability(s.get("p_value"))]
             for s in relation["slopes"]])
    return text + (
        "<p>r: Pearson's correlation, its interval by Fisher's z. p: the "
        "probability of a correlation"
        + (", of a difference from the published one," if against else "")
        + (" or of a difference of slopes" if relation.get("slopes") else "")
        + " at least as large if there were none.</p>")


def title_of(relation):
    """What a relation is called; HTML."""
    return in_page(relation.get("label") or relation.get("name") or "Relation")
