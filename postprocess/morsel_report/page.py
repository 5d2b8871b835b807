"""The page: headline, figures, tables; one file that stands alone."""
import base64
import html
import os

from . import experiment_story, food_story, plate_story, static_story, style
from .tables import effects_table, provenance, results_table

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
h3{font-size:17px;margin:30px 0 8px;font-weight:650}
figure{margin:14px 0 22px}
figure img{width:100%;height:auto;display:block}
figcaption,.above{font-size:14px;color:var(--quiet);max-width:62em;
 margin-top:6px}
.above{margin-top:26px}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:6px 28px}
.note{background:#fdf6e3;border-left:4px solid #E69F00;padding:9px 14px;
 font-size:15px;margin:12px 0;max-width:none}
table{border-collapse:collapse;width:100%;margin-bottom:12px;font-size:14.5px;
 line-height:1.4}
th{text-align:left;font-weight:600;border-bottom:2px solid #bbb;
 padding:6px 14px 6px 0;vertical-align:bottom}
td{border-bottom:1px solid #ececec;padding:6px 14px 6px 0;
 vertical-align:top}
td.n,th.n{text-align:right;white-space:nowrap;
 font-variant-numeric:tabular-nums}
td code{font-size:12.5px;color:var(--quiet);
 font-family:"DejaVu Sans Mono",Consolas,monospace}
.claims td{overflow-wrap:break-word}.claims td:first-child{width:36%}
.claims td:last-child{width:34%}
.claims small{display:block;color:var(--quiet);font-size:13px}
.scroll{overflow-x:auto}
a{color:var(--accent);text-decoration:none}.whole{white-space:nowrap}
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


def story_of(run):
    """The module that knows this kind of run.

    It has KICKER; FIGURES, (name, function of the run, caption, whether it
    is wide); SECTIONS, (title, names of figures); CARDS, (result, label); and
    the functions outcome(run), warnings_of(run) and tables(run).
    """
    if run.is_plate():
        return plate_story
    if run.is_static():
        return static_story
    return experiment_story if run.is_experiment() else food_story


def embedded(png, caption, alt):
    """A figure of the page, its picture embedded; the caption is HTML."""
    data = base64.b64encode(png).decode("ascii")
    return (f'<figure><img src="data:image/png;base64,{data}" '
            f'alt="{html.escape(alt, quote=True)}">'
            f"<figcaption>{caption}</figcaption></figure>")


def note(text):
    """Something that the reader has to know."""
    return f'<p class="note">{html.escape(text)}</p>'


def save(report, title, body):
    """Writes a page that stands alone; returns its path."""
    text = ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{html.escape(title)} · Morsel</title>"
            f"<style>{STYLE}</style></head>\n<body><main>\n"
            + "\n".join(part for part in body if part)
            + "\n</main></body></html>\n")
    temporary = report.with_suffix(".html.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, report)
    return report


def draw(run, story):
    """Draws what can be drawn; {name: png}, and notes on what failed."""
    pictures = {}
    folder = run.folder / "figures"
    folder.mkdir(exist_ok=True)
    for name, make, _, _ in story.FIGURES:
        file = folder / (name + ".png")
        # A figure of a former run must not pass for one of this run.
        file.unlink(missing_ok=True)
        png, problem = style.picture(make, run)
        if problem:
            run.notes.append(
                f"The figure '{name}' could not be drawn ({problem}).")
        if png:
            pictures[name] = png
            file.write_bytes(png)
    return pictures


def picture_of(run, name):
    """(PNG, whether it is wide) of one of the run's figures.

    LookupError: there is none; why, in a sentence.
    """
    story = story_of(run)
    found = next((f for f in story.FIGURES if f[0] == name), None)
    if found is None:
        raise LookupError(
            f"the run's report has no figure '{name}', but "
            + ", ".join(f[0] for f in story.FIGURES) + ".")
    png, problem = style.picture(found[1], run)
    if png is None and not (run.folder / "solution").is_dir():
        problem = "its fields were not kept (Study/Keep fields)"
    if png is None:
        raise LookupError(f"'{name}' could not be drawn: "
                          + (problem or "the run did not leave what it shows")
                          + ".")
    return png, found[3]


def image(story, name, pictures):
    """A figure with its caption, the picture embedded."""
    caption = next(c for n, _, c, _ in story.FIGURES if n == name)
    return embedded(pictures[name], html.escape(caption), caption)


def section(story, title, names, pictures):
    """A section with its figures: wide ones alone, narrow ones in pairs."""
    present = [n for n in names if n in pictures]
    if not present:
        return ""
    wide = {n for n, _, _, w in story.FIGURES if w}
    parts = [f"<h2>{html.escape(title)}</h2>"]
    parts += [image(story, n, pictures) for n in present if n in wide]
    narrow = [image(story, n, pictures) for n in present if n not in wide]
    if narrow:
        parts.append('<div class="pair">' + "".join(narrow) + "</div>")
    return "\n".join(parts)


def cards(run, story):
    """The few numbers that most readers come for."""
    parts = []
    for name, label in story.CARDS:
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


def compose(run, story, pictures):
    """Title and parts of the page."""
    title = (run.text("title") or run.text("scene")
             or run.folder.resolve().name)
    lead = story.outcome(run)
    body = [f'<p class="kicker">{html.escape(story.KICKER)}</p>',
            f"<h1>{html.escape(title)}</h1>"]
    if lead:
        body.append(f'<p class="lead">{html.escape(lead)}</p>')
    body.append(cards(run, story))
    body += [note(text) for text in run.notes + story.warnings_of(run)]
    body += story.tables(run)
    body += [section(story, t, names, pictures)
             for t, names in story.SECTIONS]
    body += [results_table(run), effects_table(run), provenance(run)]
    return title, body


def write(run):
    """Draws, composes and writes report.html; returns its path."""
    story = story_of(run)
    title, body = compose(run, story, draw(run, story))
    return save(run.folder / "report.html", title, body)
