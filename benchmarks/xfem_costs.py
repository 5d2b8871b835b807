#!/usr/bin/python3
"""What a cracked plate costs by XFEM, against its size (doc/performance_xfem.md).

    xfem_costs.py [--program build/morsel] [--largest N] [--repetitions N] [--csv FILE]

Runs benchmark M1 (prm/fracture/m1_xfem.prm) on one thread with uniform meshes of degree
1, 2 and 4, from a thousand unknowns to the largest number wanted. Prints tables in
Markdown: error of K_I, wall time of each part [s] and processor time of the run without
its start (a run with 13x13 cells of degree 1) [s], medians of the repetitions, and the
exponents of the unknowns, fitted by least squares to the logarithms above 20,000
unknowns. Where others use the machine, too, the processor time is the better measure.
It asserts nothing.
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENE = ROOT / "prm" / "fracture" / "m1_xfem.prm"
# Cells along a side by degree; the last come to about a million unknowns.
SIZES = {1: [21, 51, 101, 201, 401, 701], 2: [11, 25, 51, 101, 201, 351],
         4: [5, 13, 25, 51, 101, 175]}
PARTS = ["mesh", "space", "assembly", "solution", "stress intensity"]
FIT_ABOVE = 20000


def processor_time(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        sys.exit(" ".join(command) + "\n" + result.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def command_of(program, degree, cells):
    entries = {"XFEM/Degree": degree, "XFEM/Tip degree": min(degree, 3),
               "XFEM/Cells along x": cells, "XFEM/Cells along y": cells,
               "XFEM/Corner refinements": 0, "XFEM/Enrichment radius": 0.0008}
    command = [program, str(SCENE), "--threads", "1", "--quiet"]
    for key, value in entries.items():
        command += ["--set", f"{key}={value}"]
    return command


def start_up(program, repetitions):
    """Of a run that hardly computes: 13x13 cells of degree 1, some 0.01 s."""
    with tempfile.TemporaryDirectory() as folder:
        command = command_of(program, 1, 13) + ["--output", folder]
        return statistics.median(processor_time(command) for _ in range(repetitions))


def run(program, degree, cells, repetitions, start):
    command = command_of(program, degree, cells)
    times, results = [], []
    for _ in range(repetitions):
        with tempfile.TemporaryDirectory() as folder:
            times.append(processor_time(command + ["--output", folder]) - start)
            results.append(json.loads((pathlib.Path(folder) / "summary.json").read_text()))
    row = {"degree": degree, "cells": cells,
           "unknowns": int(results[0]["dof_count"]["value"]),
           "error": results[0]["stress_intensity_I"]["error"],
           "memory": max(r["peak_memory"]["value"] for r in results) / 1e6,
           "processor": max(0., statistics.median(times))}
    for part in PARTS + ["output"]:
        row[part] = statistics.median(
            p["wall_time"] for r in results for p in r["parts"] if p["name"] == part)
    return row


def exponent(rows, column):
    points = [(math.log(r["unknowns"]), math.log(r[column])) for r in rows
              if r["unknowns"] > FIT_ABOVE and r[column] > 0.]
    if len(points) < 2:
        return float("nan")
    mean = [statistics.mean(c) for c in zip(*points)]
    return (sum((x - mean[0]) * (y - mean[1]) for x, y in points)
            / sum((x - mean[0]) ** 2 for x, _ in points))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "morsel"))
    parser.add_argument("--largest", type=float, default=1.1e6, metavar="UNKNOWNS")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--csv", help="also write the rows here")
    arguments = parser.parse_args()

    start = start_up(arguments.program, max(3, arguments.repetitions))
    columns = PARTS + ["output", "processor"]
    print(f"Start: {start:.2f} s of processor time.\n")
    print("| degree | cells | unknowns | error of K_I | " + " | ".join(columns) + " | MB |")
    print("|-" * (len(columns) + 5) + "|")
    table = []
    for degree, sizes in SIZES.items():
        for cells in sizes:
            # Unknowns of the plate without its crack.
            if 2 * (degree * cells + 1) ** 2 > arguments.largest:
                continue
            row = run(arguments.program, degree, cells, arguments.repetitions, start)
            table.append(row)
            print(f"| {degree} | {cells}x{cells} | {row['unknowns']:,} | {row['error']:.1e} | "
                  + " | ".join(f"{row[c]:.3g}" for c in columns)
                  + f" | {row['memory']:.0f} |", flush=True)
    print(f"\nExponents of the unknowns, above {FIT_ABOVE:,}:\n")
    columns.append("memory")
    print("| degree | " + " | ".join(columns) + " |\n" + "|-" * (len(columns) + 1) + "|")
    for degree in SIZES:
        rows = [r for r in table if r["degree"] == degree]
        print(f"| {degree} | " + " | ".join(f"{exponent(rows, c):.2f}" for c in columns) + " |")
    if arguments.csv and table:
        with open(arguments.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, table[0].keys())
            writer.writeheader()
            writer.writerows(table)


if __name__ == "__main__":
    main()
