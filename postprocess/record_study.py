#!/usr/bin/python3
"""Puts what a study found into a record that 'morsel --plan' reads.

    record_study.py STUDY_FOLDER RECORD.json

The record stands already, with its methods but without runs (doc/planning.md says how
to write one). Each method names its sources: a series of the study, the axis that is
its size, and the quantity whose error counts. Of runs that have the size in common
(other problems, other seeds) the largest error counts; a size at which one of them
failed is left out. The script fills in the runs, the program's version and the
calibration of the machine, and leaves the rest as it is.
"""
import argparse
import json
import pathlib
import sys


def rounded(value, digits=4):
    """To so many significant digits: records are small."""
    return float(f"{value:.{digits}g}")


def measured(study, source):
    """Size, error and run of a source's runs; of failed ones the error is None."""
    found = []
    for run in study["runs"]:
        if run["series"] != source["series"]:
            continue
        size = run["axes"].get(source["size"])
        if run["status"] != "finished":
            found.append((size, None, run))
            continue
        error = run["quantities"][source["quantity"]]["error"]
        if error is None or size is None:
            sys.exit(f"A run of '{source['series']}' has no error of "
                     f"'{source['quantity']}', or no axis '{source['size']}'.")
        found.append((size, abs(error), run))
    if not found:
        sys.exit(f"The study has no series '{source['series']}'.")
    return found


def points(study, method):
    """The runs of a method: one for each size."""
    groups = {}
    for source in method["sources"]:
        for size, error, run in measured(study, source):
            groups.setdefault(size, []).append((error, source, run))
    result = []
    for size, runs in sorted(groups.items()):
        if any(error is None for error, *_ in runs):
            print(f"'{method['name']}', size {size:g}, is left out: "
                  "not all of its runs finished")
            continue
        error, source, worst = max(runs, key=lambda item: item[0])
        result.append({
            "size": size,
            "error": rounded(error),
            "smallest_error": rounded(min(item[0] for item in runs)),
            "runs": len(runs),
            "worst": {"series": source["series"], **worst["axes"]},
            "unknowns": max(r["unknowns"] or 0 for *_, r in runs),
            "processor_time": rounded(max(r["cpu_time"] for *_, r in runs)),
            "memory": max(r["memory"] or 0 for *_, r in runs),
        })
    return result


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("record", type=pathlib.Path)
    options = parser.parse_args(arguments)
    study = json.loads((options.study / "study.json").read_text())
    record = json.loads(options.record.read_text())
    for method in record["methods"]:
        method["runs"] = points(study, method)
    record["program_version"] = study["program_version"]
    record["threads"] = study["threads"]
    record["calibration"] = study.get("calibration")
    text = json.dumps(record, indent=1, ensure_ascii=False)
    options.record.write_text(text + "\n")
    count = sum(len(m["runs"]) for m in record["methods"])
    print(f"{options.record}: {count} sizes of {len(record['methods'])} methods")
    return 0


if __name__ == "__main__":
    sys.exit(main())
