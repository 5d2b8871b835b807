#!/usr/bin/python3
"""Calibrates the damage of the catalogue's materials, one after another, and
writes what was found into data/materials.json.

    calibrate_catalogue.py [--morsel build/morsel] [--output DIR] [--only NAME]
                           [--write] [-- options of the program]
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CATALOGUE = ROOT / "data" / "materials.json"
# What calibrates a kind of material: scene, its body, resolution of the runs,
# seeds.
SCENES = {"food": ("prm/food/peanut.prm", "food", 51, 3),
          "rock": ("prm/rock/basalt.prm", "rock", 150, 1)}
# The closed-form rule as it is, so that old values of the catalogue do not
# matter.
START = 1.0


def calibrate(material, arguments):
    """Runs the calibration of a material; its object "damage", or None."""
    scene, body, across, seeds = SCENES[material["kind"]]
    folder = arguments.output / material["name"].replace(" ", "_")
    command = [
        str(arguments.morsel.resolve()), "--calibrate", scene,
        "--output", str(folder.resolve()),
        "--set", f"Body {body}/Material/Name={material['name']}",
        "--set", f"Body {body}/Damage/Threshold factor={START}",
        "--set", f"Calibration/Particles across={across}",
        "--set", f"Calibration/Seeds={seeds}",
        *arguments.options]
    print(f"{material['name']}: {' '.join(command)}", flush=True)
    status = subprocess.run(command, cwd=ROOT, check=False).returncode
    if status == 130:
        raise KeyboardInterrupt
    if status != 0:
        return None
    return json.loads((folder / "calibration.json").read_text())["damage"]


def with_damage(text, name, damage):
    """The catalogue's text with the object of one entry replaced or added.

    By text, not by json.dump(), which would lose the way it is written."""
    entry = re.search(
        r'\{\s*"name": ' + re.escape(json.dumps(name)) + r'.*?\n    \}', text,
        re.S)
    old = entry.group(0)
    new = re.sub(r',\n      "damage": \{.*?\}', "", old, flags=re.S)
    new = new[:-len("\n    }")] + (
        ',\n      "damage": ' + json.dumps(damage) + "\n    }")
    return text.replace(old, new)


def main(arguments):
    """Calibrates and, if asked to, writes."""
    split = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--morsel", type=pathlib.Path,
                        default=ROOT / "build" / "morsel")
    parser.add_argument("--output", type=pathlib.Path,
                        default=ROOT / "output" / "calibration")
    parser.add_argument("--only", action="append", default=[],
                        help="a material's name; may be repeated")
    parser.add_argument("--write", action="store_true",
                        help="put the values into data/materials.json")
    chosen = parser.parse_args(arguments[:split])
    chosen.options = arguments[split + 1:]

    materials = json.loads(CATALOGUE.read_text())["materials"]
    unknown = set(chosen.only) - {m["name"] for m in materials}
    if unknown:
        parser.error(f"no material '{unknown.pop()}' in {CATALOGUE}")
    failed = []
    for material in materials:
        if chosen.only and material["name"] not in chosen.only:
            continue
        damage = calibrate(material, chosen)
        if damage is None:
            failed.append(material["name"])
        elif chosen.write:
            text = with_damage(CATALOGUE.read_text(), material["name"], damage)
            json.loads(text)
            CATALOGUE.write_text(text)
    if failed:
        print(f"Not calibrated: {', '.join(failed)}.", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
