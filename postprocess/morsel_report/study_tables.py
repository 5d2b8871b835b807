"""Tables of a study: time to reach errors, rates, draws, runs."""
import html

from . import style
from .study_data import in_page


def table(head, rows, words=(0,), kind=""):
    """A table; all columns but some hold numbers."""
    def cells(row, tag):
        return "".join(
            f'<{tag}{"" if i in words else " class=n"}>{cell}</{tag}>'
            for i, cell in enumerate(row))

    kind = f' class="{kind}"' if kind else ""
    return (f"<table{kind}><thead><tr>{cells(head, 'th')}</tr></thead><tbody>"
            + "".join(f"<tr>{cells(r, 'td')}</tr>" for r in rows)
            + "</tbody></table>")


def folded(text, summary):
    """What the reader opens if he wants to."""
    return f"<details><summary>{summary}</summary>{text}</details>"


def time_table(study, quantity):
    """Time to reach errors, by series."""
    entries = [e for e in study.data["time_to_reach"]
               if e["quantity"] == quantity]
    if not entries or not study.data["timing"]:
        return ""
    levels = [level["error"] for level in entries[0]["levels"]]
    best = [min((e["levels"][i]["time"] for e in entries
                 if e["levels"][i]["time"] is not None), default=None)
            for i in range(len(levels))]
    rows = []
    for e in entries:
        row = [html.escape(study.title_of(e["series"]))]
        for i, level in enumerate(e["levels"]):
            if level["time"] is None:
                row.append("–")
                continue
            text = style.quantity(level["time"], "s", 2)
            if level["kind"] == "at most":
                text = "≤\u202f" + text
            row.append(f"<b>{text}</b>" if level["time"] == best[i] else text)
        rows.append(row)
    return (table(["Series"] + [f"{100 * x:g}\u202f%" for x in levels], rows)
            + "<p>From this time on all runs of the series are at least as "
            "good, interpolated between runs; ≤: already the cheapest run is; "
            "–: no run is. In bold the fastest.</p>")


def rate_table(study):
    """All fitted rates."""
    rates = [f for f in study.data["rates"] if study.converges(f["quantity"])]
    if not rates:
        return ""
    rows = []
    for f in rates:
        where = ", ".join(f"{a} = {v}" for a, v in f["at"].items())
        rows.append([in_page(study.quantities[f["quantity"]]["label"]),
                     html.escape(study.title_of(f["series"])
                                 + (", " + where if where else "")),
                     f"{f['rate']:.3f}",
                     "" if f["low"] is None else
                     f"{f['low']:.2f} … {f['high']:.2f}", f["points"]])
    label = html.escape(study.data["resolution"]["label"])
    return (table(["Result", "Series", "Rate", "95\u202f% confidence",
                   "Runs"], rows, (0, 1))
            + f"<p>Error = constant · ({label})<sup>−rate</sup>.</p>")


def statistics_table(study):
    """Means and deviations over draws."""
    if not study.data["statistics"]:
        return ""
    rows = []
    known = any(s.get("absolute_error") for s in study.data["statistics"])
    for s in study.data["statistics"]:
        unit = study.quantities[s["quantity"]]["unit"]
        where = ", ".join(f"{a} = {v}" for a, v in s["at"].items())
        errors = s.get("absolute_error")
        rows.append([
            in_page(study.quantities[s["quantity"]]["label"]),
            html.escape(study.title_of(s["series"])
                        + (", " + where if where else "")),
            s["value"]["count"], style.quantity(s["value"]["mean"], unit, 6),
            style.quantity(s["value"]["standard_deviation"], unit, 3)])
        if errors:
            rows[-1] += [style.percent(share) for share in (
                s["error"]["mean"], errors["median"], errors["largest"])]
        elif known:
            rows[-1] += 3 * [""]
    text = table(["Result", "Series", "Runs", "Mean", "Deviation"]
                 + (["Mean error", "Median |error|", "Largest |error|"]
                    if known else []), rows, (0, 1))
    return folded(text, f"All {len(rows)} means") if len(rows) > 12 else text


def run_table(study, longest=40):
    """Every run; tables with more than the longest number can be opened."""
    names = list(study.quantities)
    head = ["Series", "Setting"]
    for n in names:
        label = in_page(study.quantities[n]["label"])
        head += [label] + (["error"] if study.has_errors(n) else [])
    head += ["Time", "Unknowns", "Memory"]
    rows = []
    for r in study.runs:
        row = [html.escape(study.title_of(r["series"]))]
        row.append("<br>".join(html.escape(study.name_of(a, r))
                               for a in study.axes if a in r["axes"]))
        for n in names:
            q = r["quantities"][n]
            row.append("" if q["value"] is None else html.escape(
                style.quantity(q["value"], study.quantities[n]["unit"], 6)))
            if study.has_errors(n):
                row.append("" if q["error"] is None
                           else style.percent(q["error"]))
        if r["status"] == "finished":
            row += [style.quantity(r["time"], "s", 3) if r["time"] else "",
                    style.quantity(r["unknowns"], "1") if r["unknowns"]
                    else "",
                    style.quantity(r["memory"], "B", 3) if r["memory"] else ""]
        else:
            row += [html.escape(r["status"]), "", ""]
        rows.append(row)
    text = f'<div class="scroll">{table(head, rows, (0, 1))}</div>'
    if len(rows) <= longest:
        return text
    return folded(text, f"{len(rows)} run{'s' * (len(rows) != 1)}")
