#!/usr/bin/python3
"""Fits what parts of runs cost to timing studies: data/recorded/costs.json.

    record_costs.py OUTPUT costs.json

OUTPUT holds the folders of the studies cost_xfem, cost_particles and cost_bodies
(prm/studies/planning). A cost is a sum of products of powers of sizes with coefficients
that are not negative, fitted in relative error. Times are processor times of the
process, divided between a run's parts as its wall times are, so that other work on the
machine does little harm; they are times of the machine whose calibration
stands beside them. The member 'figures' is left as it is.
"""
import argparse
import itertools
import json
import pathlib
import sys

import numpy as np

# Size exponents of the candidate terms.
SOLUTION = [{"unknowns": 1.2}, {"unknowns": 1.5}, {"order": 3}, {"cells": 1},
            {"cells": 1, "order": 4}]
FIELDS = [{}, {"parts": 1}, {"cells": 1, "order": 2}]
FINITE_MEMORY = [{}, {"unknowns": 1.2}, {"parts": 1}, {"order": 6}]
PARTICLES = [{}, {"particles": 1}, {"particles": 1.5}]
BODY = [{}, {"particles": 1}, {"particles": 1.5},
        {"particles": 1, "relaxations": 1}]
PARTICLE_MEMORY = [{}, {"particles": 1}, {"particles": 1.2}]
# Resident memory of the program before it has any unknowns [B].
PROGRAM = 1.6e8


def product(exponents, sizes):
    return np.prod([sizes[name] ** power for name, power in exponents.items()])


def fit(terms, rows, values):
    """The best subset of terms with positive coefficients; exhaustive."""
    columns = np.array([[product(t, row) for t in terms] for row in rows])
    columns = columns / np.array(values)[:, None]
    best = None
    for count in range(1, len(terms) + 1):
        for chosen in itertools.combinations(range(len(terms)), count):
            x = np.linalg.lstsq(columns[:, chosen], np.ones(len(rows)),
                                rcond=None)[0]
            miss = np.linalg.norm(columns[:, chosen] @ x - 1)
            if (x > 0).all() and (best is None or miss < best[0] - 1e-9):
                best = miss, chosen, x
    _, chosen, x = best
    ratio = columns[:, chosen] @ x
    print(f"  {len(rows)} runs, fit over measured "
          f"{ratio.min():.2f} to {ratio.max():.2f}")
    return [{"coefficient": float(f"{c:.4g}"), "exponents": terms[k]}
            for k, c in zip(chosen, x)]


def load(folder, name, series=None):
    """Sizes, processor times of solution and rest, and memory of the runs."""
    study = json.loads((folder / name / "study.json").read_text())
    rows = []
    for run in study["runs"]:
        if run["status"] != "finished" or series not in (None, run["series"]):
            continue
        found = {k: q["value"] for k, q in run["quantities"].items()}
        share = run["cpu_time"] / run["wall_time"]
        sizes = {"unknowns": run["unknowns"]}
        if name == "cost_xfem":
            degree = run["axes"]["p"]
            sizes.update(cells=found["cell_count"], order=degree + 1.,
                         parts=found["cell_count"] * (16 if degree > 1 else 1))
        else:
            sizes["particles"] = run["unknowns"] / 2
            # Lloyd iterations of an even filling, their default number.
            sizes["relaxations"] = 50. if run["series"] == "relaxed" else 0.
        rows.append((sizes, share * found["wall_time_loop"],
                     share * (found["wall_time"] - found["wall_time_loop"]),
                     run["memory"]))
    return study, rows


def part(rows, which, terms, offset=0.):
    return fit(terms, [r[0] for r in rows], [r[which] - offset for r in rows])


def with_program(terms):
    return [{"coefficient": PROGRAM, "exponents": {}}] + terms


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("costs", type=pathlib.Path)
    options = parser.parse_args(arguments)
    document = (json.loads(options.costs.read_text())
                if options.costs.exists() else {})
    parts = {}

    first, _ = load(options.folder, "cost_xfem")

    def speed(study, workload):
        return study["calibration"]["workloads"][workload]["processor_time"]

    def study(name, label, workload, solution, memory, fields):
        found, rows = load(options.folder, name)
        # All in the time of the machine as it was in the first study.
        factor = speed(first, workload) / speed(found, workload)
        rows = [(r[0], factor * r[1], factor * r[2], r[3]) for r in rows]
        source = f"prm/studies/planning/{name}.prm"
        print(label)
        parts[label + " solution"] = {
            "study": source,
            "seconds": part(rows, 1, solution),
            "bytes": with_program(part(rows, 3, memory, PROGRAM))}
        parts[label + " fields"] = {"study": source,
                                    "seconds": part(rows, 2, fields)}

    study("cost_xfem", "XFEM", "finite elements", SOLUTION, FINITE_MEMORY,
          FIELDS)
    study("cost_particles", "particle plate", "static particles", PARTICLES,
          PARTICLE_MEMORY, PARTICLES)
    study("cost_bodies", "particle body", "static particles", BODY,
          PARTICLE_MEMORY, PARTICLES)
    document.update(
        about="Costs of parts of runs in processor time [s] and resident "
              "memory [B]: sums of coefficients times powers of sizes. Made by "
              "postprocess/record_costs.py.",
        program_version=first["program_version"], parts=parts,
        calibration=first["calibration"])
    document.setdefault("figures", {})
    options.costs.write_text(json.dumps(document, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
