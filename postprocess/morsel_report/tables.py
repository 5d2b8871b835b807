"""The tables of the page: results, effects and their time, provenance."""
import html

from . import style

# Above these the reader has to know: (result, limit, sentence).
LIMITS = [
    ("kinetic_over_strain_energy_before_peak", 0.05,
     "The loading was not quasi-static: just before the peak the kinetic "
     "energy was {value} of the strain energy (5\u202f% is the limit). Inertia "
     "adds to the forces; a slower plate gives the food's own strength."),
    ("energy_balance_error_at_peak", 0.01,
     "The energy ledger is open by {value} at the peak of the force (1\u202f% is "
     "the limit): take the peak force with care."),
    ("energy_balance_error", 0.04,
     "The energy ledger is open by {value} at the end (4\u202f% is the limit): "
     "take the late part of the curves with care."),
]


def warnings_of(run):
    """Sentences on results that are beyond what can be trusted."""
    sentences = []
    for name, limit, sentence in LIMITS:
        value = run.value(name)
        if value is not None and abs(value) > limit:
            sentences.append(sentence.format(value=style.percent(abs(value))))
    if run.value("complete_failure") == 0:
        sentences.append(
            "The food did not fail completely before the run ended: strength "
            "and pieces are those of a part of the stroke.")
    return sentences


def shown(name, value, unit):
    """A result as the tables show it."""
    if style.is_share(name, unit):
        return style.percent(value)
    return style.quantity(value, unit)


def results_table(run):
    """All scalar results."""
    results = run.results()
    if not results:
        return ""
    references = any("reference" in e or "error" in e
                     for e in results.values())
    head = '<th>Result</th><th class="n">Value</th>'
    if references:
        head += '<th class="n">Expected</th><th class="n">Error</th>'
    rows = []
    for name, entry in results.items():
        unit = entry.get("unit", "1")
        meaning = entry.get("meaning") or name.replace("_", " ")
        meaning = meaning[:1].upper() + meaning[1:]
        row = (f"<td>{html.escape(meaning)}<br>"
               f"<code>{html.escape(name)}</code></td>"
               f'<td class="n">{html.escape(shown(name, entry["value"], unit))}'
               "</td>")
        if references:
            expected = (html.escape(shown(name, entry["reference"], unit))
                        if "reference" in entry else "")
            error = style.percent(entry["error"]) if "error" in entry else ""
            row += f'<td class="n">{expected}</td><td class="n">{error}</td>'
        rows.append(f"<tr>{row}</tr>")
    return (f"<h2>All results</h2><table><thead><tr>{head}</tr></thead>"
            f"<tbody>{''.join(rows)}</tbody></table>")


def bar(share):
    """A bar for a share of the time."""
    width = max(0.0, min(1.0, share))
    return f'<span class="bar" style="width:{100 * width:.1f}%"></span>'


def timed(entry):
    """The wall time of an entry, 0 where it has none."""
    value = entry.get("wall_time", 0.0)
    return float(value) if isinstance(value, (int, float)) else 0.0


def effects_table(run):
    """The effects that were on, who asked for them, and the time of each."""
    effects = run.summary.get("effects") or []
    parts = run.summary.get("parts") or []
    if not effects and not parts:
        return ""
    total = run.value("wall_time_loop") or run.value("wall_time") or 0.0
    total = max([total] + [timed(e) for e in effects + parts])
    text = "<h2>Effects, and the time that each took</h2>"
    if effects:
        rows = []
        for e in sorted(effects, key=lambda e: not e.get("on")):
            share = timed(e) / total if total else 0.0
            time = style.quantity(timed(e), "s", 3) if timed(e) else ""
            rows.append(
                f'<tr{"" if e.get("on") else " class=off"}>'
                f'<td>{html.escape(str(e.get("name", "")))}</td>'
                f'<td>{"on" if e.get("on") else "off"}</td>'
                f'<td>{html.escape(str(e.get("reason", "")))}</td>'
                f'<td class="n">{time}</td><td style="width:22%">'
                f'{bar(share) if timed(e) else ""}</td></tr>')
        text += ("<table><thead><tr><th>Effect</th><th></th><th>Why</th>"
                 '<th class="n">Time</th><th></th></tr></thead><tbody>'
                 + "".join(rows) + "</tbody></table>")
    if parts:
        rows = "".join(
            f'<tr><td>{html.escape(str(p.get("name", "")))}</td>'
            f'<td class="n">{style.quantity(timed(p), "s", 3)}</td>'
            f'<td style="width:45%">{bar(timed(p) / total if total else 0)}'
            "</td></tr>" for p in sorted(parts, key=timed, reverse=True))
        text += ("<br><table><thead><tr><th>Part of the program</th>"
                 '<th class="n">Time</th><th></th></tr></thead><tbody>'
                 + rows + "</tbody></table>")
    return text


def provenance(run):
    """Versions, hashes, and the parameters that reproduce the run."""
    texts = run.summary.get("text") or {}
    rows = "".join(
        f"<tr><td>{html.escape(name.replace('_', ' '))}</td>"
        f"<td>{html.escape(str(value))}</td></tr>"
        for name, value in texts.items()
        if name not in ("title", "outcome"))
    text = ""
    if rows:
        text += f"<table><tbody>{rows}</tbody></table>"
    if run.parameters:
        text += ("<details><summary>All parameters of this run (used.prm)"
                 f"</summary><pre>{html.escape(run.parameters)}</pre>"
                 "</details>")
    files = [name for name in ("summary.json", "history.csv", "used.prm",
                               "fragments.csv", "stress_intensity.csv",
                               "crack_opening.csv", "tip_stress.csv",
                               "run.log", "solution", "figures")
             if (run.folder / name).exists()]
    text += ("<p>Beside this page: " + ", ".join(files)
             + ". ParaView opens what ends in .xdmf or .pvd in solution.</p>")
    return "<h2>Where this comes from</h2>" + text
