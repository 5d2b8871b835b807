"""The page of a study: figures, tables, what failed."""
import base64
import html
import os

from . import kernels, style
from .page import STYLE
from .study_data import Study, in_page
from .study_figures import FIGURES
from .study_tables import (rate_table, run_table, statistics_table,
                           time_table)


def draw(study, notes):
    """All figures that the study calls for: [(name, caption, png)]."""
    folder = study.folder / "figures"
    folder.mkdir(exist_ok=True)
    # Figures of a former report, which must not pass for this one's.
    for name in ["kernels", *(figure[0] for figure in FIGURES)]:
        for old in folder.glob(f"{name}_*.png"):
            old.unlink()
    pictures = []
    wanted = [(quantity, entry, *figure)
              for quantity, entry in study.quantities.items()
              for figure in FIGURES]
    if kernels.is_stability_study(study):
        wanted.insert(0, (
            "all", {"label": "Kernels"}, "kernels",
            lambda *_: kernels.figure_of_kernels(),
            "The kernels with their derivatives. At the nearest neighbours "
            "tension is unstable where W'' is positive, and compression "
            "where it is negative (T3-32)."))
    for quantity, entry, name, make, caption in wanted:
        png, problem = style.picture(make, study, quantity)
        if problem:
            notes.append(f"The figure '{name}' of {quantity} could not be "
                         f"drawn ({problem}).")
        if png:
            (folder / f"{name}_{quantity}.png").write_bytes(png)
            pictures.append((entry["label"], caption, png))
    return pictures


def picture(label, caption, png):
    """A figure of the page."""
    data = base64.b64encode(png).decode("ascii")
    text = html.escape(caption)
    return (f'<figure><img src="data:image/png;base64,{data}" alt="{text}">'
            f"<figcaption><b>{in_page(label)}.</b> {text}</figcaption>"
            "</figure>")


def failures(study):
    """A note for the runs that failed, with their reasons."""
    titles = {s["name"]: s["title"] for s in study.series}
    failed = [r for r in study.runs if r["status"] == "failed"]
    notes = []
    for r in failed[:20]:
        where = ", ".join(f"{a} = {v if isinstance(v, str) else f'{v:g}'}"
                          for a, v in r["axes"].items())
        notes.append(f"Failed: {titles[r['series']]}, {where}: "
                     f"{r['message']}")
    if len(failed) > 20:
        notes.append(f"{len(failed) - 20} further runs failed; see study.csv.")
    waiting = sum(r["status"] == "not run" for r in study.runs)
    if waiting:
        notes.append(f"{waiting} of {len(study.runs)} runs have not been "
                     "carried out yet: the same command goes on with them.")
    return notes


def write(folder):
    """Draws, composes and writes report.html of a study; returns its path."""
    study = Study(folder)
    notes = []
    pictures = draw(study, notes)
    title = study.data["title"] or study.data["name"]
    finished = sum(r["status"] == "finished" for r in study.runs)
    body = ['<p class="kicker">MORSEL · a study</p>',
            f"<h1>{html.escape(title)}</h1>",
            f'<p class="lead">{finished} of {len(study.runs)} runs finished, '
            f"in {len(study.series)} series.</p>"]
    body += [f'<p class="note">{html.escape(note)}</p>'
             for note in notes + failures(study)]
    body += ["<h2>What the study shows</h2>"] if pictures else []
    body += [picture(*p) for p in pictures]
    body += [time_table(study, q) for q in study.quantities]
    body += [rate_table(study), statistics_table(study), run_table(study)]
    body.append("<h2>Where this comes from</h2><p>Study "
                f"<code>{html.escape(study.data['study'])}</code>, program "
                f"version {html.escape(study.data['program_version'])}. Beside "
                "this page: study.csv, study.json, used.prm, run.log, figures, "
                "runs.</p>")
    text = ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width">'
            f"<title>{html.escape(title)} · Morsel</title>"
            f"<style>{STYLE}</style></head>\n<body><main>\n"
            + "\n".join(part for part in body if part)
            + "\n</main></body></html>\n")
    report = study.folder / "report.html"
    temporary = report.with_suffix(".html.tmp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, report)
    return report
