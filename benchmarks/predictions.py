#!/usr/bin/python3
"""What 'morsel --validate' predicts and what then happens, over the gallery.

    predictions.py [--program build/morsel] [--threads N] [--repetitions N] [NAME ...]

For each scene of prm/food, prm/fracture and prm/sph: --validate, then at once the run,
from the start of the program to its end. Prints a table in Markdown: wall time and
processor time [s] and largest resident memory [MB], predicted and measured, their ratios,
and the load of the machine before. Where others use the machine, too, the wall time
tells what they did in between, and the processor time what the program did. Long runs
have an earlier end or fewer particles here; studies are left out. It asserts nothing.
"""
import argparse
import json
import math
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
COARSE_BLOCK = ["Body food/Particles/Particles across=51"]
SHORTENED = {
    "almond": COARSE_BLOCK,
    "peanut": COARSE_BLOCK,
    "raw_carrot": COARSE_BLOCK,
    "m2_sph": ["SPH/Particles along x=100", "SPH/Particles along y=100"],
    "axial_stress_block": ["Time/End time=0.003"],
    "beam_classical": ["Time/End time=0.2"],
    "beam_large_load": ["Time/End time=0.2"],
    "beam_per_axis": ["Time/End time=0.2"],
    "beam_total_lagrangian": ["Time/End time=0.2"],
    "cracked_plate": ["Time/End time=0.0005"],
    "objectivity": ["Time/End time=0.01"],
    "oscillating_plate": ["Time/End time=0.2"],
    "tension_block": ["Time/End time=0.1"],
    "tension_block_artificial_stress": ["Time/End time=0.1"],
    "tension_block_slow_load": ["Time/End time=0.1"],
    "tension_block_updated": ["Time/End time=0.1"],
}


def scenes(names):
    for folder in ("food", "fracture", "sph"):
        for scene in sorted((ROOT / "prm" / folder).glob("*.prm")):
            is_study = "subsection Study" in scene.read_text()
            if not is_study and (not names or scene.stem in names):
                yield scene


def call(command):
    """Output, wall time, processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.monotonic()
    result = subprocess.run(command, capture_output=True, text=True)
    wall = time.monotonic() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        sys.exit(" ".join(command) + "\n" + result.stderr)
    return (result.stdout, wall, after.ru_utime + after.ru_stime
            - before.ru_utime - before.ru_stime)


def predicted(text):
    found_time = re.search(r"Predicted time +about ([0-9.]+) s", text)
    found_memory = re.search(r"Predicted memory +about ([0-9.]+) MB", text)
    found_processor = re.search(r"([0-9.]+) s of processor time", text)
    return (float(found_time[1]), float(found_processor[1]),
            float(found_memory[1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "morsel"))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repetitions", type=int, default=1)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    print("| scene | predicted s | measured s | ratio | predicted processor s | "
          "measured processor s | ratio | predicted MB | measured MB | ratio | "
          "load |")
    print("|-|-|-|-|-|-|-|-|-|-|-|", flush=True)
    ratios, processor_ratios, memory_ratios = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes(options.names):
            command = [options.program, "--threads", str(options.threads),
                       str(scene)]
            for entry in SHORTENED.get(scene.stem, []):
                command += ["--set", entry]
            for _ in range(options.repetitions):
                load = os.getloadavg()[0]
                text, _, _ = call(command + ["--validate"])
                seconds, expected, memory = predicted(text)
                _, wall, processor = call(
                    command + ["--quiet", "--output", folder + "/run"])
                summary = json.loads(
                    pathlib.Path(folder, "run", "summary.json").read_text())
                peak = 1e-6 * summary["peak_memory"]["value"]
                ratios.append(seconds / wall)
                memory_ratios.append(memory / peak)
                processor_ratios.append(expected / processor)
                print(f"| {scene.stem} | {seconds:.2f} | {wall:.2f} | "
                      f"{ratios[-1]:.2f} | {expected:.2f} | {processor:.2f} | "
                      f"{processor_ratios[-1]:.2f} | {memory:.0f} | "
                      f"{peak:.0f} | {memory_ratios[-1]:.2f} | {load:.1f} |",
                      flush=True)
    for name, values in (("time", ratios), ("processor time", processor_ratios),
                         ("memory", memory_ratios)):
        within = sum(1 / 1.5 <= r <= 1.5 for r in values)
        spread = statistics.pstdev([math.log(r) for r in values])
        print(f"\n{name}: {within} of {len(values)} within a factor 1.5; "
              f"ratios {min(values):.2f} to {max(values):.2f}, median "
              f"{statistics.median(values):.2f}, spread {math.exp(spread):.2f}")


if __name__ == "__main__":
    main()
