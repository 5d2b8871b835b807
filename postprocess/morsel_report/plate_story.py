"""What the page tells of a cracked plate."""
import html

import numpy as np

from . import plate, style

KICKER = "MORSEL · stress intensity at crack tips"

FIGURES = [
    ("deformed", plate.deformed,
     "The deformed plate, its cracks open, coloured by the von Mises stress. "
     "The colours end where 99 percent of the plate's area stay below: the "
     "stress at a crack tip has no bound.", True),
    ("tip_field", plate.tip_field,
     "The stress about the tips as computed, beside the singular field that "
     "the stress intensity factors measured there belong to, on one scale; "
     "right, their difference, which stays bounded: the plate's other terms, "
     "the stress along the crack first among them.", True),
    ("tip_lines", plate.tip_lines,
     "Left, the stress straight ahead of the tip; right, around it. Dashed: "
     "the singular field of the factors measured, without the plate's other "
     "terms (the stress along the crack among them).", True),
    ("enrichment", plate.enrichment,
     "The mesh, which knows nothing of the cracks; the nodes whose functions "
     "bring in the jump and the singularity; the rings of the interaction "
     "integral, whose weight falls from 1 at the dashed circle to 0 at the "
     "full one.", True),
    ("ring_values", plate.ring_values,
     "The factors by ring: how far they scatter tells how far they can be "
     "trusted.", False),
    ("opening", plate.opening,
     "How far the crack's faces are apart, and the law that holds near the "
     "tip.", False),
]

SECTIONS = [
    ("The plate under load", ["deformed"]),
    ("At the crack tips", ["tip_field", "tip_lines", "ring_values",
                           "opening"]),
    ("Mesh, enrichment and rings", ["enrichment"]),
]

CARDS = [
    ("stress_intensity_I", "stress intensity, mode I"),
    ("stress_intensity_II", "stress intensity, mode II"),
    ("stress_intensity_I_tip1", "mode I at the second tip"),
    ("stress_intensity_II_tip1", "mode II at the second tip"),
    ("stress_intensity_I_over_formula", "K_I over the handbook formula"),
    ("strain_energy", "strain energy, per metre of depth"),
]

# A spread beyond this share of |K| is more than a reader should overlook.
TRUSTED_SPREAD = 0.01


def outcome(run):
    """What was found, in a sentence or two of plain language."""
    tips = len(run.tips)
    cracks = 0 if run.cracks is None else len(run.cracks.offsets)
    sentence = "A plate"
    if run.plate is not None:
        width, height = 1e3 * np.ptp(run.plate.points, axis=0)
        sentence += f" of {width:.4g} by {height:.4g} mm"
    if not cracks and not tips:
        return sentence + " without a crack: plain elasticity."
    sentence += (f" with {cracks} crack{'s' * (cracks != 1)} and "
                 f"{tips} tip{'s' * (tips != 1)}")
    found = run.results().get("stress_intensity_I")
    if found:
        sentence += (": K_I is "
                     + style.quantity(found["value"], "Pa sqrt(m)", 5))
        if tips > 1:
            sentence += " at the first tip"
        if "error" in found:
            sentence += (", " + style.percent(abs(found["error"]), 2)
                         + (" above" if found["error"] > 0 else " below")
                         + " the reference")
        if tips:
            spread = np.ptp(run.tips[0].mode_I)
            sentence += (", and its rings agree to "
                         + style.percent(spread / (abs(found["value"])
                                                   or 1.0), 2))
    sentence += "."
    unknowns, time = run.value("dof_count"), run.value("wall_time_loop")
    if unknowns and time:
        sentence += (f" It took {style.digits(unknowns)} unknowns and "
                     + style.quantity(time, "s", 2) + ".")
    return sentence


def warnings_of(run):
    """The run's own advice, and rings that disagree."""
    sentences = [line.split("Advice: ", 1)[1]
                 for line in run.log.splitlines()
                 if line.startswith("Advice: ")]
    for tip in run.tips:
        size = np.hypot(np.mean(tip.mode_I), np.mean(tip.mode_II))
        spread = max(np.ptp(tip.mode_I), np.ptp(tip.mode_II))
        if size > 0 and spread > TRUSTED_SPREAD * size:
            sentences.append(
                f"The rings of tip {tip.number} disagree by "
                f"{style.percent(spread / size)} of |K|: take a finer mesh "
                "about the tip.")
    return sentences


def tables(run):
    """The factors of every tip, with what is expected."""
    if not run.tips:
        return []
    rows = []
    results = run.results()
    for tip in run.tips:
        suffix = tip.suffix(run.tips)
        for mode in ("I", "II"):
            entry = results.get(f"stress_intensity_{mode}" + suffix)
            if entry is None:
                continue
            spread = run.value(f"stress_intensity_{mode}_spread" + suffix)
            cells = [style.quantity(entry["value"], "Pa sqrt(m)", 7),
                     "" if spread is None
                     else style.quantity(spread, "Pa sqrt(m)", 2),
                     style.quantity(entry["reference"], "Pa sqrt(m)", 7)
                     if "reference" in entry else "",
                     style.percent(entry["error"], 2)
                     if "error" in entry else ""]
            place = ("({:.4g}, {:.4g}) mm".format(*(1e3 * tip.place))
                     if mode == "I" else "")
            rows.append(
                f"<tr><td>{'Tip ' + str(tip.number) if place else ''}</td>"
                f"<td>{place}</td><td>K<sub>{mode}</sub></td>"
                + "".join(f'<td class="n">{html.escape(c)}</td>'
                          for c in cells) + "</tr>")
    return ["<h2>Stress intensity factors</h2><table><thead><tr><th></th>"
            '<th>Place</th><th></th><th class="n">Value</th>'
            '<th class="n">Spread of the rings</th>'
            '<th class="n">Expected</th><th class="n">Error</th></tr>'
            "</thead><tbody>" + "".join(rows) + "</tbody></table>"]
