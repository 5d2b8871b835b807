#!/usr/bin/python3
"""What 'morsel --plan' proposes for cracked plates, and what the proposal then reaches.

    plans.py [--program build/morsel] [--threads N] ACCURACY ...

For the edge crack (M1) and the centre crack (M2) with truths from an independent p-version:
plans each accuracy, runs the command that is proposed, and prints a table in Markdown of
errors wanted and reached, and times predicted and measured. Problems marked * are
not among those that the record was made from. It asserts nothing.
"""
import argparse
import json
import math
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
ENDS = ["Boundary/Bottom support=free", "Boundary/Bottom traction=0, -1000"]


def edge(name, length, ratio, extra=()):
    """Length over width; K_I over sigma sqrt(pi a)."""
    entries = [f"Cracks/Paths=0, 0.005 > {0.01 * length:g}, 0.005"]
    truth = 1000 * ratio * math.sqrt(math.pi * 0.01 * length)
    return name, "m1_xfem", entries + list(extra), truth


def centre(name, angle, ratio, extra=()):
    truth = 1000 * ratio * math.sqrt(math.pi * 0.0005)
    return name, "m2_xfem", [f"Cracks/Angle={angle}"] + list(extra), truth


TALL = ["Plate/Upper corner=0.01, 0.02", "Cracks/Paths=0, 0.01 > 0.001, 0.01"]
PROBLEMS = [
    edge("M1 (a)", 0.1, 1.1496039),
    edge("M1 (a), a/W 0.2 *", 0.2, 1.368177),
    edge("M1 (a), a/W 0.4", 0.4, 2.160593),
    edge("M1 (b) *", 0.1, 1.2291704, ENDS),
    edge("M1 (a), H/W 2 *", 0.1, 1.1807251, TALL),
    centre("M2 (a), 0 degrees", 0, 1.0364731),
    centre("M2 (a), 30 degrees *", 30, 0.7841918),
    centre("M2 (a), 45 degrees", 45, 0.5318736),
    centre("M2 (b), 45 degrees *", 45, 0.5062398, ENDS),
]


def call(command):
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        return None, result.stderr.strip()
    return result.stdout, ""


def seconds_of(text):
    found = re.search(r"Predicted time +about ([0-9.]+) (s|min|h)", text)
    return float(found[1]) * {"s": 1, "min": 60, "h": 3600}[found[2]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "morsel"))
    parser.add_argument("--threads", default="1")
    parser.add_argument("accuracy", nargs="+")
    options = parser.parse_args()
    print("| problem | wanted | proposed | reached | predicted s | measured s "
          "| ratio |\n|-|-|-|-|-|-|-|", flush=True)
    held, total = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name, scene, entries, truth in PROBLEMS:
            for accuracy in options.accuracy:
                base = [options.program, "--threads", options.threads]
                sets = [word for entry in entries for word in ("--set", entry)]
                path = str(ROOT / "prm" / "fracture" / f"{scene}.prm")
                text, problem = call(
                    base + ["--plan", accuracy] + sets + [path])
                if text is None:
                    print(f"| {name} | {accuracy} | {problem} | | | | |")
                    continue
                proposed = re.search(r"^Chosen: (.*)\.$", text, re.M)[1]
                command = text[text.index("\n  morsel"):]
                words = shlex.split(command.replace("\\\n", " "))[1:]
                begin = time.monotonic()
                done, problem = call(
                    base + ["--quiet", "--output", folder + "/run"] + words)
                wall = time.monotonic() - begin
                if done is None:
                    print(f"| {name} | {accuracy} | {proposed} | {problem} | | | |")
                    continue
                summary = json.loads(
                    pathlib.Path(folder, "run", "summary.json").read_text())
                error = summary["stress_intensity_I"]["value"] / truth - 1
                wanted = (float(accuracy[:-1]) / 100 if accuracy[-1] == "%"
                          else float(accuracy))
                held += abs(error) <= wanted
                total += 1
                seconds = seconds_of(text)
                print(f"| {name} | {accuracy} | {proposed} | {error:.1e} | "
                      f"{seconds:.2f} | {wall:.2f} | {seconds / wall:.2f} |",
                      flush=True)
    print(f"\n{held} of {total} reach what was wanted")


if __name__ == "__main__":
    sys.exit(main())
