"""What publications state, beside what a study finds."""
import html

from . import style
from .study_data import in_page
from .study_tables import table


def numbers_of(claim):
    """Stated, ours and their difference as texts; empty where unknown."""
    stated, ours = claim.get("stated"), claim.get("ours")
    unit = claim.get("unit") or "1"
    largest = max((abs(v) for v in (stated, ours) if v is not None), default=0)
    factor, prefixed = style.prefix_of(largest, unit)
    name = style.pretty_unit(prefixed)
    name = "\u202f" + name if name else ""
    texts = ["", "", ""]
    if stated is not None:
        texts[0] = style.plain(factor * stated) + name
    if ours is not None:
        deviation = claim.get("ours_deviation")
        texts[1] = style.measured(
            factor * ours, deviation and factor * deviation) + name
    if claim.get("difference") is not None:
        texts[2] = style.difference(claim["difference"])
    return texts


def measured_by(study, claim):
    """What of the study stands beside the claim; HTML."""
    if claim.get("relation"):
        name = claim["relation"]
        label = next((r["label"] for r in study.data["relations"]
                      if r.get("name") == name), name)
        text = "Correlation: " + in_page(label)
    elif claim.get("quantity"):
        text = in_page(study.label_of(claim["quantity"]))
    else:
        return ""
    if claim.get("series") and len(study.series) > 1:
        text += ", " + html.escape(study.title_of(claim["series"]))
    if (claim.get("count") or 0) > 1 and not claim.get("relation"):
        text += f", mean of {claim['count']} draws"
    return text


def claims_table(study):
    """All claims of a study, one row each."""
    rows = []
    for claim in study.data["claims"]:
        by = measured_by(study, claim)
        statement = (f"<small>{html.escape(claim.get('source') or '')}</small>"
                     + html.escape(claim.get("says") or "")
                     + (f"<small>Here: {by}</small>" if by else ""))
        words = [f"<b>{html.escape(claim['finding'])}</b>"
                 if claim.get("finding") else "",
                 html.escape(claim.get("why") or "")]
        rows.append([statement, *map(html.escape, numbers_of(claim)),
                     "<br>".join(w for w in words if w)])
    if not rows:
        return ""
    return table(["Published", "Stated", "Ours", "Difference",
                  "What we find, and why"], rows, (0, 4), "claims")


def overview_rows(study, link):
    """The study's claims with numbers, rows that link to its section."""
    rows = []
    for claim in study.data["claims"]:
        numbers = numbers_of(claim)
        if numbers[0]:
            source = html.escape(claim.get("source") or study.title)
            rows.append([f'<a href="#{link}">{source}</a>',
                         measured_by(study, claim),
                         *(html.escape(n) or "–" for n in numbers)])
    return rows


def overview(rows):
    """The table of such rows."""
    return table(["Published", "What", "Stated", "Ours", "Difference"], rows,
                 (0, 1))
