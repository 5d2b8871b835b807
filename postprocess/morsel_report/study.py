"""The page of a study: claims, figures, tables, what failed."""
import html

from . import kernels, page, style
from .study_claims import claims_table
from .study_data import Study, capital, in_page
from .study_figures import FIGURES
from .study_relations import (relation_caption, relation_figure,
                              relation_tables, title_of)
from .study_runs import grid_of, history_figure, run_pictures
from .study_sensitivity import tornado, tornado_caption, tornado_table
from .study_tables import (rate_table, run_table, statistics_table,
                           time_table)

QUICK = ("The quick setting: fewer values or coarser ones, for a first look. "
         "The numbers to quote are those of the full setting.")


def drawing(study, file, what, make, *arguments):
    """The PNG of a figure, saved in figures/; None where there is none."""
    png, problem = style.picture(make, *arguments)
    if problem:
        study.notes.append(f"{what} could not be drawn ({problem}).")
    if png:
        (study.folder / "figures" / f"{file}.png").write_bytes(png)
    return png


def captioned(label, caption, png):
    """A figure of the page; label is HTML."""
    caption = html.escape(caption)
    return page.embedded(png, f"<b>{label}.</b> {caption}", caption)


def own_figure(study, entry):
    """A figure that the study's file asks for."""
    name, title = entry["name"], entry.get("title") or entry["name"]
    caption = entry.get("caption") or ""
    if entry["kind"] == "history":
        png = drawing(study, f"figure_{name}", f"The figure '{name}'",
                      history_figure, study, entry)
        return captioned(in_page(title), caption, png) if png else ""
    if entry["kind"] != "picture":
        raise ValueError(f"its kind is '{entry['kind']}'")
    pictures = run_pictures(study, entry)
    for k, (_, png) in enumerate(pictures):
        (study.folder / "figures" / f"picture_{name}_{k}.png").write_bytes(png)
    if not pictures:
        return ""
    return (f'<p class="above"><b>{in_page(title)}.</b> '
            f"{html.escape(caption)}</p>{grid_of(pictures)}")


def relation_part(study, relation):
    """Figure and tables of a relation."""
    name = relation["name"]
    png = drawing(study, f"relation_{name}", f"The relation '{name}'",
                  relation_figure, study, relation)
    if not png:
        return ""
    return captioned(title_of(relation), relation_caption(study, relation),
                     png) + relation_tables(study, relation)


def sensitivity_part(study, quantity):
    """Tornado and table of a quantity."""
    png = drawing(study, f"tornado_{quantity}",
                  f"The tornado of {quantity}", tornado, study, quantity)
    if not png:
        return ""
    return captioned(
        "Sensitivity of " + in_page(study.label_of(quantity)),
        tornado_caption(study, quantity), png) + tornado_table(study, quantity)


def automatic_figures(study):
    """The figures that are called for by what varies."""
    wanted = [(quantity, study.label_of(quantity), *figure)
              for quantity in study.drawn() for figure in FIGURES]
    if kernels.is_stability_study(study):
        wanted.insert(0, (
            "all", "Kernels", "kernels",
            lambda *_: kernels.figure_of_kernels(),
            "The kernels with their derivatives. At the nearest neighbours "
            "tension is unstable where W'' is positive, and compression "
            "where it is negative (T3-32)."))
    parts = []
    for quantity, label, name, make, caption in wanted:
        png = drawing(study, f"{name}_{quantity}",
                      f"The figure '{name}' of {quantity}", make, study,
                      quantity)
        if png:
            parts.append(captioned(in_page(capital(label)), caption,
                                   png))
    return "\n".join(parts)


def figures_of(study):
    """All figures of a study; those of a former report are removed."""
    folder = study.folder / "figures"
    folder.mkdir(exist_ok=True)
    for name in ["kernels", "figure", "picture", "relation", "tornado",
                 *(figure[0] for figure in FIGURES)]:
        for old in folder.glob(f"{name}_*.png"):
            old.unlink()
    parts = [study.attempt(f"The figure '{entry.get('name')}'", own_figure,
                     study, entry) for entry in study.data["figures"]]
    parts += [study.attempt(f"The relation '{relation.get('name')}'",
                      relation_part, study, relation)
              for relation in study.data["relations"]]
    parts += [study.attempt("The sensitivities", sensitivity_part, study,
                            quantity) for quantity in study.drawn()]
    parts.append(study.attempt("A figure", automatic_figures, study))
    return "\n".join(part for part in parts if part)


def variation_of(run):
    """[(what, value)] that a run varies beside the axes."""
    variation = run.get("variation")
    return ([(variation["sensitivity"], variation["value"])]
            if variation else [])


def failures(study):
    """Notes for the runs that failed, with their reasons."""
    failed = [r for r in study.all_runs if r["status"] == "failed"]
    notes = []
    for r in failed[:20]:
        which = ", ".join([study.title_of(r["series"])] + [
            f"{a} = {v if isinstance(v, str) else f'{v:g}'}"
            for a, v in [*r["axes"].items(), *variation_of(r)]])
        notes.append(f"Failed: {which}: {r['message']}")
    if len(failed) > 20:
        notes.append(f"{len(failed) - 20} further runs failed; see study.csv.")
    waiting = sum(r["status"] == "not run" for r in study.all_runs)
    if waiting:
        notes.append(f"{waiting} of {len(study.all_runs)} runs have not been "
                     "carried out yet: the same command goes on with them.")
    return notes


def contents(study, level=2, longest=40):
    """What a page shows of a study, below headings of this level; tables of
    more runs than the longest number are folded."""
    parts = [("Beside what is published",
              study.attempt("The claims", claims_table, study)),
             ("What the study shows", figures_of(study))]
    parts += [(f"Time to reach an error of {in_page(study.label_of(q))}",
               study.attempt("The times to reach errors", time_table, study,
                       q)) for q in study.quantities]
    parts += [("Convergence rates",
               study.attempt("The rates", rate_table, study)),
              ("Over the draws",
               study.attempt("The statistics", statistics_table, study)),
              ("All runs",
               study.attempt("The runs", run_table, study, longest))]
    failed = study.attempt("What failed", failures, study) or []
    notes = ([QUICK] if study.data.get("quick") else []) + study.notes + failed
    return [page.note(text) for text in notes] + [
        f"<h{level}>{title}</h{level}>\n{text}"
        for title, text in parts if text]


def write(folder):
    """Draws, composes and writes report.html of a study; returns its path."""
    study = Study(folder)
    finished = sum(r.get("status") == "finished" for r in study.all_runs)
    body = ['<p class="kicker">MORSEL · a study</p>',
            f"<h1>{in_page(study.title)}</h1>",
            f'<p class="lead">{finished} of {len(study.all_runs)} runs finished, '
            f"in {len(study.series)} series.</p>"]
    body += contents(study)
    body.append("<h2>Where this comes from</h2><p>Study "
                f"<code>{html.escape(study.text('study'))}</code>, program "
                f"version {html.escape(study.text('program_version'))}. Beside "
                "this page: study.csv, study.json, used.prm, run.log, figures, "
                "runs.</p>")
    return page.save(study.folder / "report.html", study.title, body)
