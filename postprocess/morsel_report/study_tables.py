"""Tables of a study: time to reach errors, rates, draws, runs."""
import html

from . import style
from .study_data import in_page


def table(head, rows, first=1):
    """A table; all columns but the first ones hold numbers."""
    def cells(row, tag):
        return "".join(
            f'<{tag}{"" if i < first else " class=n"}>{cell}</{tag}>'
            for i, cell in enumerate(row))

    return ("<table><thead><tr>" + cells(head, "th") + "</tr></thead><tbody>"
            + "".join(f"<tr>{cells(r, 'td')}</tr>" for r in rows)
            + "</tbody></table>")


def time_table(study, quantity):
    """Time to reach errors, by series."""
    entries = [e for e in study.data["time_to_reach"]
               if e["quantity"] == quantity]
    if not entries or not study.data["timing"]:
        return ""
    titles = {s["name"]: s["title"] for s in study.series}
    levels = [level["error"] for level in entries[0]["levels"]]
    best = [min((e["levels"][i]["time"] for e in entries
                 if e["levels"][i]["time"] is not None), default=None)
            for i in range(len(levels))]
    rows = []
    for e in entries:
        row = [html.escape(titles[e["series"]])]
        for i, level in enumerate(e["levels"]):
            if level["time"] is None:
                row.append("–")
                continue
            text = style.quantity(level["time"], "s", 2)
            if level["kind"] == "at most":
                text = "≤\u202f" + text
            row.append(f"<b>{text}</b>" if level["time"] == best[i] else text)
        rows.append(row)
    label = in_page(study.quantities[quantity]["label"])
    return (f"<h2>Time to reach an error of {label}</h2>"
            + table(["Series"] + [f"{100 * x:g}\u202f%" for x in levels], rows)
            + "<p>From this time on all runs of the series are at least as "
            "good, interpolated between runs; ≤: already the cheapest run is; "
            "–: no run is. In bold the fastest.</p>")


def rate_table(study):
    """All fitted rates."""
    rates = [f for f in study.data["rates"] if study.converges(f["quantity"])]
    if not rates:
        return ""
    titles = {s["name"]: s["title"] for s in study.series}
    rows = []
    for f in rates:
        where = ", ".join(f"{a} = {v}" for a, v in f["at"].items())
        rows.append([in_page(study.quantities[f["quantity"]]["label"]),
                     html.escape(titles[f["series"]]
                                 + (", " + where if where else "")),
                     f"{f['rate']:.3f}",
                     "" if f["low"] is None else
                     f"{f['low']:.2f} … {f['high']:.2f}", f["points"]])
    label = html.escape(study.data["resolution"]["label"])
    return ("<h2>Convergence rates</h2>"
            + table(["Result", "Series", "Rate", "95\u202f% confidence",
                     "Runs"], rows, 2)
            + f"<p>Error = constant · ({label})<sup>−rate</sup>.</p>")


def statistics_table(study):
    """Means and deviations over draws."""
    if not study.data["statistics"]:
        return ""
    titles = {s["name"]: s["title"] for s in study.series}
    rows = []
    for s in study.data["statistics"]:
        unit = study.quantities[s["quantity"]]["unit"]
        where = ", ".join(f"{a} = {v}" for a, v in s["at"].items())
        errors = s.get("absolute_error")
        rows.append([
            in_page(study.quantities[s["quantity"]]["label"]),
            html.escape(titles[s["series"]] + (", " + where if where else "")),
            s["value"]["count"], style.quantity(s["value"]["mean"], unit, 6),
            style.quantity(s["value"]["standard_deviation"], unit, 3),
            style.percent(s["error"]["mean"]) if errors else "",
            style.percent(errors["median"]) if errors else "",
            style.percent(errors["largest"]) if errors else ""])
    return ("<h2>Over the draws</h2>"
            + table(["Result", "Series", "Runs", "Mean", "Deviation",
                     "Mean error", "Median |error|", "Largest |error|"],
                    rows, 2))


def run_table(study):
    """Every run; long tables can be opened."""
    names = list(study.quantities)
    head = ["Series", "Setting"]
    for n in names:
        label = in_page(study.quantities[n]["label"])
        head += [label] + (["error"] if study.has_errors(n) else [])
    head += ["Time", "Unknowns", "Memory"]
    titles = {s["name"]: s["title"] for s in study.series}
    rows = []
    for r in study.runs:
        row = [html.escape(titles[r["series"]])]
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
    text = table(head, rows, 2)
    if len(rows) > 40:
        text = (f"<details><summary>All {len(rows)} runs</summary>{text}"
                "</details>")
    return "<h2>All runs</h2>" + text
