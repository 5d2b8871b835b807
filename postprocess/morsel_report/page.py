"""The page: headline, figures, tables; one file that stands alone."""
import base64
import html
import io
import os

import matplotlib.pyplot as plt

from . import curves, food, style
from .tables import effects_table, provenance, results_table, warnings_of

FIGURES = [
    ("moments", food.moments,
     "The food at several moments, between the plates (dark). Top, damage: "
     "from intact to failed. Below, the von Mises stress: where the food is "
     "about to give way.", True),
    ("fragments", food.fragments,
     "The pieces that are left, each in its own colour and numbered by size; "
     "light grey is what has failed altogether, darker grey are crumbs too "
     "small to count.", True),
    ("force", curves.force_over_time, "Force on the plates over time.", False),
    ("stress_strain", curves.stress_over_strain,
     "Nominal stress (mean force over the loaded area) against nominal "
     "strain.", False),
    ("fragment_sizes", curves.fragment_sizes,
     "How large the pieces are: bars for each, line for their sum.", False),
    ("failed_share", curves.failed_share,
     "How much of the food has failed altogether.", False),
    ("energy", curves.energy_ledger,
     "Where the work of the plates goes: blue and green is stored, warm "
     "colours are spent. What separates the stack from the black line is the "
     "closing error, shown below.", True),
]

SECTIONS = [
    ("The food between the plates", ["moments"]),
    ("The pieces", ["fragments", "fragment_sizes", "failed_share"]),
    ("Force and stress", ["force", "stress_strain"]),
    ("The energy ledger", ["energy"]),
]

STYLE = """
:root{--ink:#222;--quiet:#667;--rule:#dcdcdc;--accent:#0072B2}
*{box-sizing:border-box}
body{margin:0;background:#f5f4f1;color:var(--ink);
 font:16px/1.55 "Segoe UI","Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
main{max-width:1080px;margin:0 auto;background:#fff;padding:40px 52px 56px}
h1{font-size:32px;line-height:1.2;margin:0 0 6px;font-weight:650}
h2{font-size:21px;margin:44px 0 12px;padding-top:18px;
 border-top:1px solid var(--rule);font-weight:650}
p{margin:8px 0;max-width:46em}
.kicker{color:var(--quiet);font-size:14px;letter-spacing:.04em;margin:0 0 10px}
.lead{font-size:19px;line-height:1.5;max-width:44em}
.cards{display:flex;flex-wrap:wrap;gap:14px;margin:26px 0 8px}
.card{flex:1 1 190px;border:1px solid var(--rule);border-radius:6px;
 padding:13px 16px 12px}
.card b{display:block;font-size:25px;font-weight:600;line-height:1.25;
 white-space:nowrap}
.card span{display:block;font-size:13.5px;color:var(--quiet);line-height:1.35}
figure{margin:14px 0 22px}
figure img{width:100%;height:auto;display:block}
figcaption{font-size:14px;color:var(--quiet);max-width:62em;margin-top:6px}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:6px 28px}
.note{background:#fdf6e3;border-left:4px solid #E69F00;padding:9px 14px;
 font-size:15px;margin:12px 0;max-width:none}
table{border-collapse:collapse;width:100%;font-size:14.5px;line-height:1.4}
th{text-align:left;font-weight:600;border-bottom:2px solid #bbb;
 padding:6px 14px 6px 0;vertical-align:bottom}
td{border-bottom:1px solid #ececec;padding:6px 14px 6px 0;
 vertical-align:top}
td.n,th.n{text-align:right;white-space:nowrap;
 font-variant-numeric:tabular-nums}
td code{font-size:12.5px;color:var(--quiet);
 font-family:"DejaVu Sans Mono",Consolas,monospace}
.bar{display:block;background:var(--accent);height:9px;border-radius:2px;
 min-width:1px}
.off td{color:#8a8a8a}
details{margin-top:14px}summary{cursor:pointer;color:var(--accent)}
pre{font:12.5px/1.45 "DejaVu Sans Mono",Consolas,monospace;overflow:auto;
 background:#f7f7f5;padding:14px 16px}
@media(max-width:760px){main{padding:24px 18px}.pair{grid-template-columns:1fr}}
@media print{body{background:#fff}main{padding:0}h2{break-after:avoid}
 figure,tr{break-inside:avoid}}
"""


def draw(run):
    """Draws what can be drawn; {name: png}, and notes on what failed."""
    pictures = {}
    folder = run.folder / "figures"
    folder.mkdir(exist_ok=True)
    for name, make, _, _ in FIGURES:
        file = folder / (name + ".png")
        # A figure of a former run must not pass for one of this run.
        file.unlink(missing_ok=True)
        try:
            figure = make(run)
        except (ValueError, IndexError, KeyError, TypeError) as error:
            run.notes.append(
                f"The figure '{name}' could not be drawn ({error}).")
            plt.close("all")
            continue
        if figure is None:
            continue
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        plt.close(figure)
        pictures[name] = buffer.getvalue()
        file.write_bytes(buffer.getvalue())
    return pictures


def image(name, pictures):
    """A figure with its caption, the picture embedded."""
    caption = next(c for n, _, c, _ in FIGURES if n == name)
    data = base64.b64encode(pictures[name]).decode("ascii")
    return (f'<figure><img src="data:image/png;base64,{data}" '
            f'alt="{html.escape(caption, quote=True)}">'
            f"<figcaption>{html.escape(caption)}</figcaption></figure>")


def section(title, names, pictures):
    """A section with its figures: wide ones alone, narrow ones in pairs."""
    present = [n for n in names if n in pictures]
    if not present:
        return ""
    wide = {n for n, _, _, w in FIGURES if w}
    parts = [f"<h2>{html.escape(title)}</h2>"]
    parts += [image(n, pictures) for n in present if n in wide]
    narrow = [image(n, pictures) for n in present if n not in wide]
    if narrow:
        parts.append('<div class="pair">' + "".join(narrow) + "</div>")
    return "\n".join(parts)


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
    return " ".join(sentences)


CARDS = [
    ("peak_occlusal_force", "peak occlusal force"),
    ("compressive_strength", "compressive strength"),
    ("masticatory_performance", "masticatory performance, largest piece"),
    ("masticatory_performance_all_fragments",
     "masticatory performance, all pieces"),
    ("fragment_count", "pieces of at least 0.5 % of the mass"),
    ("stress_intensity_I", "stress intensity, mode I"),
    ("stress_intensity_II", "stress intensity, mode II"),
]


def cards(run):
    """The few numbers that most readers come for."""
    parts = []
    for name, label in CARDS:
        entry = run.results().get(name)
        if entry is None:
            continue
        value = style.quantity(entry["value"], entry.get("unit", "1"), 3)
        detail = label
        if "error" in entry and "reference" in entry:
            detail += (f"; {style.percent(entry['error'])} from the expected "
                       + style.quantity(entry["reference"],
                                        entry.get("unit", "1"), 4))
        parts.append(f'<div class="card"><b>{html.escape(value)}</b>'
                     f"<span>{html.escape(detail)}</span></div>")
    return '<div class="cards">' + "".join(parts) + "</div>" if parts else ""


def compose(run, pictures):
    """The whole page as text."""
    title = (run.text("title") or run.text("scene")
             or run.folder.resolve().name)
    lead = outcome(run)
    body = ['<p class="kicker">MORSEL · how food breaks between teeth</p>',
            f"<h1>{html.escape(title)}</h1>"]
    if lead:
        body.append(f'<p class="lead">{html.escape(lead)}</p>')
    body.append(cards(run))
    body += [f'<p class="note">{html.escape(note)}</p>'
             for note in run.notes + warnings_of(run)]
    body += [section(t, names, pictures) for t, names in SECTIONS]
    body += [results_table(run), effects_table(run), provenance(run)]
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{html.escape(title)} · Morsel</title>"
            f"<style>{STYLE}</style></head>\n<body><main>\n"
            + "\n".join(part for part in body if part)
            + "\n</main></body></html>\n")


def write(run):
    """Draws, composes and writes report.html; returns its path."""
    text = compose(run, draw(run))
    report = run.folder / "report.html"
    temporary = report.with_suffix(".html.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, report)
    return report
