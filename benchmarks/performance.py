#!/usr/bin/python3
"""How fast the program is: throughput, scaling and memory of prm/performance.

    performance.py [--program build/morsel] [--repetitions N] [--largest PARTICLES] [--output FOLDER]

Runs each case several times and takes medians; runs that are compared (one rank and two)
take turns. Writes FOLDER/performance.csv and FOLDER/performance.png (cost against size with
fitted exponents) and prints tables in Markdown. It asserts nothing.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ROOT / "prm" / "performance"
SIZES = [32, 56, 100, 178, 316, 562, 1000, 1414]


def run(program, scene, settings, threads, ranks=1):
    """Wall time of the process and what summary.json says."""
    with tempfile.TemporaryDirectory() as folder:
        command = [str(program), str(scene), "--quiet", "--threads", str(threads),
                   "--output", folder + "/run"]
        for entry in settings:
            command += ["--set", entry]
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks), "--bind-to", "core"] + command
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1",
                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        begin = time.monotonic()
        result = subprocess.run(command, capture_output=True, text=True, env=environment)
        wall = time.monotonic() - begin
        if result.returncode != 0:
            raise SystemExit(" ".join(command) + "\n" + result.stderr)
        summary = json.loads(pathlib.Path(folder, "run", "summary.json").read_text())
        return wall, {name: entry["value"] for name, entry in summary.items()
                      if isinstance(entry, dict) and "value" in entry}


class Case:
    """A scene of prm/performance at one size, long enough to be timed."""

    def __init__(self, program, scene, across, threads, ranks=1, body="block"):
        self.program, self.threads, self.ranks = program, threads, ranks
        self.scene = SCENES / (scene + ".prm")
        self.settings = [f"Body {body}/Particles/Particles across={across}"]
        _, short = run(program, self.scene, self.settings + ["Time/End time=1e-12"],
                       threads)
        # About half a second; the food must not fail yet.
        steps = max(60, round((6e6 if body == "food" else 4e7) / across**2))
        self.settings.append(f"Time/End time={steps * short['time_step']}")
        self.speeds, self.memory, self.walls = [], 0, []
        self.particles = across * across

    def repeat(self):
        wall, summary = run(self.program, self.scene, self.settings, self.threads,
                            self.ranks)
        self.walls.append(wall)
        self.speeds.append(summary["particle_steps_per_second"])
        self.memory = max(self.memory, summary["peak_memory"])

    @property
    def speed(self):
        return statistics.median(self.speeds)


def throughput(arguments, rows):
    print("| scene | particles | threads | million particle-steps/s | memory [B/particle] |\n"
          "|-|-|-|-|-|")
    points = []
    base = None
    for across in SIZES:
        if across**2 > 1.02 * arguments.largest:
            continue
        case = Case(arguments.program, "elastic_block", across, 2)
        for _ in range(arguments.repetitions):
            case.repeat()
        base = base or case.memory
        per_particle = (case.memory - base) / case.particles
        print(f"| elastic_block | {case.particles} | 2 | {case.speed / 1e6:.1f} | "
              f"{per_particle:.0f} |", flush=True)
        rows.append(["elastic_block", case.particles, 2, 1, case.speed, case.memory])
        points.append((case.particles, case.particles / case.speed))
    full = Case(arguments.program, "full_physics", 100, 2, body="food")
    for _ in range(arguments.repetitions):
        full.repeat()
    print(f"| full_physics | {full.particles} | 2 | {full.speed / 1e6:.1f} | |")
    rows.append(["full_physics", full.particles, 2, 1, full.speed, full.memory])
    return points


def ranks(arguments, rows):
    print("\n| particles | one rank | two ranks | ratio, median of pairs |\n|-|-|-|-|")
    for across in (100, 316, 1000):
        if across**2 > 1.02 * arguments.largest:
            continue
        pair = [Case(arguments.program, "elastic_stroke", across, 1, n) for n in (1, 2)]
        for _ in range(arguments.repetitions):
            for case in pair:
                case.repeat()
        ratio = statistics.median(b / a for a, b in zip(pair[0].speeds, pair[1].speeds))
        print(f"| {pair[0].particles} | {pair[0].speed / 1e6:.1f} | "
              f"{pair[1].speed / 1e6:.1f} | {ratio:.2f} |", flush=True)
        for case in pair:
            rows.append(["elastic_stroke", case.particles, 1, case.ranks, case.speed,
                         case.memory])


def whole_runs(arguments):
    print("\n| run | wall time [s] |\n|-|-|")
    for name, command in {
            "start of the program (--version)": ["--version"],
            "peanut to complete failure": [str(ROOT / "prm/food/peanut.prm")],
            "M1 by particles, the thesis's": [str(ROOT / "prm/fracture/m1_sph_thesis.prm")],
            "M1 by XFEM": [str(ROOT / "prm/fracture/m1_xfem.prm")]}.items():
        walls = []
        for _ in range(arguments.repetitions):
            with tempfile.TemporaryDirectory() as folder:
                options = [] if command[0].startswith("-") else [
                    "--quiet", "--output", folder + "/run"]
                begin = time.monotonic()
                subprocess.run([str(arguments.program)] + command + options, check=True,
                               capture_output=True)
                walls.append(time.monotonic() - begin)
        print(f"| {name} | {statistics.median(walls):.2f} |", flush=True)


def draw(points, file_name):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6, 4.2), constrained_layout=True)
    axes.loglog(*zip(*[(n, 1e3 * t) for n, t in points]), "o-", label="elastic block, 2 threads")
    for part, label, offset, side in ((slice(0, 4), "small", (12, -14), "left"),
                                      (slice(-4, None), "large", (-12, 12), "right")):
        x = [math.log(n) for n, _ in points[part]]
        y = [math.log(t) for _, t in points[part]]
        slope, _ = statistics.linear_regression(x, y)
        middle = points[part][1]
        axes.annotate(f"{label}: time ~ N^{slope:.2f}", (middle[0], 1e3 * middle[1]),
                      textcoords="offset points", xytext=offset, ha=side)
        print(f"Exponent of {label} sizes: {slope:.3f}")
    axes.set_xlabel("particles N")
    axes.set_ylabel("time of a step [ms]")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.savefig(file_name, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "morsel")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--largest", type=float, default=2e6)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("performance"))
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = []
    points = throughput(arguments, rows)
    ranks(arguments, rows)
    whole_runs(arguments)
    with open(arguments.output / "performance.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "particles", "threads", "ranks",
                         "particle_steps_per_second", "peak_memory [B]"])
        writer.writerows(rows)
    if len(points) >= 4:
        draw(points, arguments.output / "performance.png")


if __name__ == "__main__":
    main()
