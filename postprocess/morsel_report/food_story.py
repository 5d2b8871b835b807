"""What the page tells of food between plates."""
from . import curves, drives, food, style, teeth, tooth_cracks
from .tables import warnings_of

# Of measured fracture patterns; dust at random stays below.
LEAST_SHARPNESS = 0.05

KICKER = "MORSEL · how food breaks between teeth"

FIGURES = [
    ("moments", food.moments,
     "The food at several moments, between the plates (dark). Top, damage: "
     "from intact to failed. Below, the von Mises stress: where the food is "
     "about to give way. Arrows: the force of the food on each tooth, at its "
     "mean place of contact.", True),
    ("fragments", food.fragments,
     "The pieces that are left, each in its own colour and numbered by size; "
     "light grey is what has failed altogether, darker grey are crumbs too "
     "small to count.", True),
    ("tractions", teeth.tractions,
     "What the surfaces of plates and teeth felt at the peak of the force: "
     "normal pressure and tangential traction, smoothed over the width of a "
     "particle.", True),
    ("force", curves.force_over_time, "Force on the plates over time.", False),
    ("tooth_cracks", tooth_cracks.stress_intensity_over_time,
     "Stress intensity at the tips of the teeth's cracks: where the equivalent "
     "of K_I and K_II reaches the toughness K_Ic the crack would grow. Grey: "
     "the force on the tooth.", True),
    ("open_cracks", tooth_cracks.open_cracks,
     "The teeth that deform when K was largest, magnified: their cracks are "
     "open.", True),
    ("stress_strain", curves.stress_over_strain,
     "Nominal stress (mean force over the loaded area) against nominal "
     "strain: the slope of the rise, the peak, where it had fallen to half, "
     "and what is carried on.", False),
    ("fragment_sizes", curves.fragment_sizes,
     "How large the pieces are: bars for each, line for their sum.", False),
    ("fragment_distribution", curves.fragment_distribution,
     "How fine the food has become: the share of its mass in pieces below a "
     "size.", False),
    ("failed_share", curves.failed_share,
     "How much of the food has failed altogether.", False),
    ("closing", drives.closing,
     "Force, and the speed at which the tooth closes along the direction of "
     "closing: hard food slows a jaw or a driven mass, its break sets it "
     "free.", False),
    ("muscles", drives.muscles,
     "The moment of the muscles about the condyle, which falls as they "
     "shorten faster, and where their work goes.", False),
    ("energy", curves.energy_ledger,
     "Where the work of the plates goes: blue and green is stored, warm "
     "colours are spent. What separates the stack from the black line is the "
     "closing error, shown below.", True),
]

SECTIONS = [
    ("The food between the plates", ["moments"]),
    ("The pieces", ["fragments", "fragment_sizes", "fragment_distribution",
                    "failed_share"]),
    ("Force and stress", ["force", "stress_strain", "tractions"]),
    ("What moves the teeth", ["closing", "muscles"]),
    ("Cracks in the teeth", ["tooth_cracks", "open_cracks"]),
    ("The energy ledger", ["energy"]),
]

CARDS = [
    ("peak_occlusal_force", "peak occlusal force"),
    ("compressive_strength", "compressive strength"),
    ("masticatory_performance", "masticatory performance, largest piece"),
    ("masticatory_performance_all_fragments",
     "masticatory performance, all pieces"),
    ("fragment_count", "pieces of at least 0.5 % of the mass"),
]


def outcome(run):
    """What happened, in a sentence or two of plain language."""
    given = run.text("outcome")
    sentences = [given] if given else []
    strain = run.column("nominal_strain")
    peak, reached = run.peak_time(), run.value("complete_failure")
    if not given and peak is not None:
        verb = ("broke completely" if reached else
                "was loaded" if reached is None else
                "did not fail completely")
        force = run.value("peak_occlusal_force", float(max(run.mean_force())))
        sentence = (f"The food {verb}: the force rose to "
                    f"{style.quantity(force, 'N', 3)}")
        at_peak = run.at("nominal_strain", peak)
        if at_peak is not None:
            sentence += f" at {style.percent(at_peak)} compression"
        if strain is not None and len(strain):
            sentence += (", and the plates stopped at "
                         f"{style.percent(float(strain[-1]))}")
        sentences.append(sentence + ".")
    count, largest = (run.value("fragment_count"),
                      run.value("largest_fragment_share"))
    if not given and count is not None:
        if count == 1:
            text = "One piece is left"
        else:
            text = f"It is in {int(count)} pieces" if count else (
                "No piece large enough to count is left")
        if largest and count > 1:
            text += f", the largest with {style.percent(largest)} of the mass"
        failed = run.value("failed_share")
        if failed:
            text += (f"; {style.percent(failed)} of the mass has crumbled to "
                     "dust")
        sentences.append(text + ".")
    if not given and count is not None:
        sentences += direction(run)
    sentences += tooth_cracks.outcome(run)
    return " ".join(sentences)


def direction(run):
    """Which way the damage runs, where it does run one way."""
    angle, sharpness = (run.value("fracture_angle"),
                        run.value("fracture_sharpness"))
    if angle is None or sharpness is None:
        return []
    if sharpness < LEAST_SHARPNESS:
        return ["When the force had fallen to half, the damage had no clear "
                "direction."]
    return [f"When the force had fallen to half, the damage ran at "
            f"{angle:.0f}° to the direction of loading."]


def tables(_run):
    """No tables but those that every page has."""
    return []
