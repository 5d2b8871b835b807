"""The page of a collection of studies: all their claims, then each study."""
import html
import pathlib

from . import page, style, study_claims
from .reader import NoRun
from .study import contents
from .study_data import Study, in_page, read_document
from .study_tables import table

QUICK = ("The quick setting: every study in fewer or coarser runs, for a "
         "first look. The numbers to quote are those of the full setting.")


class Part:
    """A study of a collection, as far as it came."""

    def __init__(self, folder, entry, number):
        self.link = f"part{number}"
        self.entry = entry
        self.notes = []
        self.study = None
        self.status = self.text("status") or "not run"
        if self.text("message"):
            self.notes.append(f"{self.status.capitalize()}: "
                              + self.text("message"))
        elif self.status == "failed":
            self.notes.append("Failed; see its run.log.")
        where = folder / self.text("folder")
        try:
            if self.text("folder") and (where / "study.json").is_file():
                self.study = Study(where)
            elif self.status == "finished":
                self.notes.append("Its study.json is missing.")
            elif self.status != "failed":
                self.notes.append("This study has not been run yet: the same "
                                  "command goes on with it.")
        except (NoRun, OSError) as error:
            self.notes.append(str(error))
        self.title = (self.text("title")
                      or (self.study.title if self.study else "")
                      or self.text("name") or self.text("file") or "A study")

    def text(self, name):
        """A text of the part's entry; empty where there is none."""
        return str(self.entry.get(name) or "")

    def number(self, name):
        """A number of the part's entry, or None."""
        value = self.entry.get(name)
        return value if isinstance(value, (int, float)) else None

    def runs(self):
        """"12 runs, 1 failed"."""
        runs, failed = self.number("runs"), self.number("failed_runs")
        text = "" if runs is None else f"{runs} run{'s' * (runs != 1)}"
        return text + (f", {failed} failed" if failed else "")

    def time(self):
        """The time of its runs, or its wall time; empty where neither is
        known. The wall time is short where finished runs were not repeated.
        """
        value = self.number("run_time") or self.number("wall_time")
        return style.duration(value) if value else ""

    def body(self):
        """The part's section of the page."""
        source = " · ".join(t for t in (self.text("file"), self.runs(),
                                        self.time()) if t)
        body = [f'<h2 id="{self.link}">{in_page(self.title)}</h2>',
                f'<p class="kicker">{html.escape(source)}</p>']
        body += [page.note(text) for text in self.notes]
        if self.study:
            # A study of a quick collection need not say so once more.
            self.study.data["quick"] = False
            body += contents(self.study, level=3, longest=0)
        return body


def table_of_contents(parts):
    """The parts with their status, runs and times, as links."""
    rows = [[f'<a href="#{p.link}">{in_page(p.title)}</a>',
             html.escape(p.status), p.runs(), html.escape(p.time())]
            for p in parts]
    return table(["Part", "Status", "Runs", "Time of its runs"], rows, (0, 1))


def lead(parts, document):
    """How far the collection came, in a sentence."""
    finished = sum(p.status == "finished" for p in parts)
    text = f"{finished} of {len(parts)} studies finished"
    runs = sum(p.number("runs") or 0 for p in parts)
    text += f", {runs} runs in all." if runs else "."
    time = document.get("wall_time")
    if isinstance(time, (int, float)) and time > 0:
        text += f" The last command took {style.duration(time)}."
    return text


def write(folder):
    """Writes report.html of a collection; returns its path."""
    folder = pathlib.Path(folder)
    document = read_document(folder / "collection.json")
    entries = document.get("parts")
    if not isinstance(entries, list):
        raise NoRun(f"'{folder}/collection.json' is no collection's: its "
                    "'parts' cannot be read.")
    parts = [Part(folder, entry if isinstance(entry, dict) else {}, k)
             for k, entry in enumerate(entries)]
    title = str(document.get("title") or document.get("name")
                or "A collection of studies")
    body = ['<p class="kicker">MORSEL · a collection of studies</p>',
            f"<h1>{html.escape(title)}</h1>",
            f'<p class="lead">{lead(parts, document)}</p>']
    body += [f"<p>{html.escape(paragraph)}</p>" for paragraph in
             str(document.get("introduction") or "").split("\n\n")
             if paragraph]
    body += [page.note(QUICK)] if document.get("quick") else []
    body += ["<h2>Contents</h2>", table_of_contents(parts)]
    claims = study_claims.overview([(p.study, p.link) for p in parts
                                    if p.study])
    body += ["<h2>Published numbers, and ours</h2>", claims] if claims else []
    for part in parts:
        body += part.body()
    body.append(
        "<h2>Where this comes from</h2><p>Collection "
        f"<code>{html.escape(str(document.get('collection') or ''))}</code>, "
        "program version "
        f"{html.escape(str(document.get('program_version') or ''))}. Beside "
        "this page: collection.json, used.prm, run.log, and parts, with a "
        "folder for each study.</p>")
    return page.save(folder / "report.html", title, body)
