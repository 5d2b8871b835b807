"""What publications state, beside what a study finds."""
import html

from . import style
from .study_data import in_page
from .study_relations import correlation
from .study_tables import table


def group_of(study, claim):
    """The group of a relation whose correlation is a claim's; None without."""
    found = [g for r in study.data["relations"]
             if r.get("name") == claim["relation"] for g in r["groups"]
             if claim.get("series") in (None, "", g["series"])]
    return found[0] if len(found) == 1 else None


def numbers_of(study, claim):
    """Stated, ours and their difference as texts; empty where unknown.

    Correlations have their interval, and differ by a number, not a share."""
    stated, ours = claim.get("stated"), claim.get("ours")
    unit = claim.get("unit") or study.unit_of(claim.get("quantity"))
    largest = max((abs(v) for v in (stated, ours) if v is not None), default=0)
    factor, prefixed = style.prefix_of(largest, unit)
    name = style.pretty_unit(prefixed)
    name = "\u202f" + name if name else ""
    texts = ["", "", ""]
    if stated is not None:
        texts[0] = style.plain(factor * stated) + name
    if claim.get("relation"):
        group = group_of(study, claim)
        texts[1] = (correlation(group) if group else
                    "" if ours is None else style.digits(ours, 3))
        if None not in (stated, ours):
            texts[2] = style.shift(ours - stated)
    elif ours is not None:
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
    if claim.get("at"):
        text += ", " + html.escape(claim["at"])
    if (claim.get("count") or 0) > 1 and not claim.get("relation"):
        text += f", mean of {claim['count']} draws"
    return text


def claim_row(study, claim):
    """A row of the table of claims."""
    by = measured_by(study, claim)
    statement = (f"<small>{html.escape(claim.get('source') or '')}</small>"
                 + in_page(claim.get("says") or "")
                 + (f"<small>Here: {by}</small>" if by else ""))
    words = [f"<b>{in_page(claim['finding'])}</b>"
             if claim.get("finding") else "",
             in_page(claim.get("why") or ""),
             "<small>No number of ours: " + html.escape(claim["note"])
             + ".</small>" if claim.get("note") else ""]
    return [statement, *map(html.escape, numbers_of(study, claim)),
            "<br>".join(w for w in words if w)]


def rows_of(study, make, *arguments):
    """A row for each claim that can be read."""
    rows = [study.attempt(f"The claim '{claim.get('name')}'", make, study,
                          claim, *arguments)
            for claim in study.data["claims"]]
    return [row for row in rows if row]


def claims_table(study):
    """All claims of a study, one row each."""
    rows = rows_of(study, claim_row)
    if not rows:
        return ""
    return table(["Published", "Stated", "Ours", "Difference",
                  "What we find, and why"], rows, (0, 4), "claims")


def overview_row(study, claim, link):
    """A row of the overview of a collection, if the claim has a number."""
    numbers = numbers_of(study, claim)
    if not numbers[0]:
        return []
    source = html.escape(claim.get("source") or study.title)
    kind = ' class="whole"' if len(source) < 28 else ""
    return [f'<a href="#{link}"{kind}>{source}</a>', measured_by(study, claim),
            *(html.escape(n) or "–" for n in numbers)]


def overview(parts):
    """The claims with numbers of studies, [(study, link to its section)]."""
    rows = [row for study, link in parts
            for row in rows_of(study, overview_row, link)]
    if not rows:
        return ""
    return table(["Published", "What", "Stated", "Ours", "Difference"], rows,
                 (0, 1))
