"""Writes the files of an invented run: a block that is pressed and breaks.

The shapes are plausible, the physics is not; what matters is that every file
has the layout that the program writes.
"""
import json
import pathlib

import h5py
import numpy as np

HEADER = """<?xml version="1.0" ?>
<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>
<Xdmf Version="2.0"><Domain>
<Grid Name="CellTime" GridType="Collection" CollectionType="Temporal">
"""
GRID = """<Grid Name="mesh" GridType="Uniform"><Time Value="{time}"/>
<Geometry GeometryType="XY"><DataItem Dimensions="{n} 2" NumberType="Float"
 Precision="8" Format="HDF">
{file}:/nodes
</DataItem></Geometry>
<Topology TopologyType="{topology}" NumberOfElements="{cells}"/></Grid>
"""
FOOTER = "</Grid></Domain></Xdmf>\n"
HEIGHT, DEPTH, STRENGTH, SPEED = 0.01, 0.01, 101.2e3, 0.1


def write_frames(folder, name, topology, frames):
    """frames: [(time, {dataset: array})]."""
    folder.mkdir(parents=True, exist_ok=True)
    text = HEADER
    for k, (time, data) in enumerate(frames):
        file = f"{name}_{k:06d}.h5"
        with h5py.File(folder / file, "w") as h5:
            for key, values in data.items():
                values = np.asarray(values)
                if values.ndim == 1:
                    values = values[:, None]
                h5[key] = values
        text += GRID.format(time=time, n=len(data["nodes"]), file=file,
                            topology=topology, cells=len(data["cells"]))
    (folder / f"{name}.xdmf").write_text(text + FOOTER, encoding="utf-8")


def history():
    """Time, strain, and the stress of a brittle block."""
    t = np.linspace(0.0, 0.02, 600)
    strain = SPEED * t / HEIGHT
    peak = 0.068
    rising = 1.003 * STRENGTH * strain / peak * (1.06 - 0.06 * strain / peak)
    falling = STRENGTH * (0.12 + 0.88 * np.exp(-(strain - peak) / 0.004))
    stress = np.where(strain <= peak, rising, falling)
    ripple = 1.0 + 0.02 * np.sin(2500.0 * t) * (strain < peak)
    return t, strain, stress * ripple, peak


def write_history(folder, complete=True):
    """history.csv with every agreed column, or a few of them."""
    t, strain, stress, peak = history()
    force = stress * HEIGHT * DEPTH
    work = np.concatenate([[0.0], np.cumsum(
        0.5 * (force[1:] + force[:-1]) * np.diff(t) * SPEED)])
    broken = np.clip((strain - peak) / 0.02, 0.0, 1.0)
    columns = {"time [s]": t, "closure [m]": strain * HEIGHT,
               "nominal_strain [1]": strain, "nominal_stress [Pa]": stress,
               "force_upper_plate [N]": force,
               "force_lower_plate [N]": force * (1 + 0.03 * np.sin(900 * t))}
    if complete:
        spent = broken * work
        columns.update({
            "tangential_force_upper_plate [N]": 0.08 * force,
            "tangential_force_lower_plate [N]": 0.06 * force,
            "strain_energy [J]": 0.93 * (work - spent),
            "hourglass_energy [J]": 0.01 * (work - spent),
            "kinetic_energy [J]": 0.03 * work,
            "contact_energy [J]": 0.03 * (work - spent),
            "granular_energy [J]": 0.05 * spent,
            "external_work [J]": work,
            "dissipated_viscosity [J]": 0.2 * spent,
            "dissipated_damage [J]": 0.6 * spent,
            "dissipated_friction [J]": 0.09 * spent,
            "energy_error [1]": 0.004 * np.sqrt(t / t[-1]) + 0.02 * broken,
            "failed_share [1]": 0.27 * broken,
            "step [1]": np.arange(len(t)), "time_step [s]": 0 * t + 2e-6})
    rows = np.array(list(columns.values())).T
    with open(folder / "history.csv", "w", encoding="utf-8") as stream:
        stream.write(",".join(columns) + "\n")
        for row in rows:
            stream.write(",".join(f"{x:.10g}" for x in row) + "\n")


def pieces(points, seed=4, count=18):
    """Voronoi pieces with dust between them: labels by size, -1 for dust."""
    random = np.random.default_rng(seed)
    centres = random.uniform(0, HEIGHT, (count, 2))
    distance = np.linalg.norm(points[:, None] - centres[None], axis=2)
    order = np.argsort(distance, axis=1)
    first = np.take_along_axis(distance, order[:, :1], 1)[:, 0]
    second = np.take_along_axis(distance, order[:, 1:2], 1)[:, 0]
    labels = order[:, 0]
    sizes = np.bincount(labels, minlength=count)
    rank = np.argsort(np.argsort(-sizes))
    labels = rank[labels]
    labels[second - first < 3.5e-4] = -1
    return labels


def write_fields(folder, across=101, fields=True):
    """Particle and plate frames; returns the labels at the end."""
    dp = HEIGHT / across
    axis = (np.arange(across) + 0.5) * dp
    x, y = np.meshgrid(axis, axis)
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    labels = pieces(points)
    t, strain, stress, peak = history()
    centre = np.array([[points[labels == k].mean(axis=0)[0]
                        if np.any(labels == k) else HEIGHT / 2
                        for k in range(labels.max() + 1)]])
    food, plates = [], []
    for time in np.linspace(0.0, t[-1], 21):
        e = np.interp(time, t, strain)
        s = np.interp(time, t, stress)
        after = max(e - peak, 0.0)
        moved = points * [1 + 0.3 * min(e, peak), 1 - e]
        drift = (centre[0][labels] - HEIGHT / 2) * 2.5 * after
        moved[:, 0] += np.where(labels >= 0, drift, drift * 0.6)
        wave = 0.75 + 0.25 * np.cos(9e2 * points[:, 0]) * np.cos(
            7e2 * points[:, 1])
        damage = np.where(labels < 0, 1.0, 0.25 * wave) * min(
            1.0, (e / peak) ** 8)
        data = {"nodes": moved, "cells": np.arange(len(points))}
        if fields:
            data.update({"damage": damage,
                         "von_mises": s * wave * (1 - damage),
                         "stress_yy": -s * wave, "stress_xx": 0.2 * s * wave,
                         "fragment": np.where(damage >= 1, -1, labels)
                         if after else np.zeros(len(points)),
                         "velocity": np.zeros((len(points), 3))})
        food.append((time, data))
        top = HEIGHT * (1 - e)
        left, right = -0.4 * HEIGHT, 1.4 * HEIGHT
        nodes = np.array([[left, -0.002], [right, -0.002], [right, 0.0],
                          [left, 0.0], [left, top], [right, top],
                          [right, top + 0.002], [left, top + 0.002]])
        plates.append((time, {"nodes": nodes, "plate": [0.0] * 4 + [1.0] * 4,
                              "cells": [[0, 1, 2, 3], [4, 5, 6, 7]]}))
    write_frames(folder / "solution", "food", "Polyvertex", food)
    write_frames(folder / "solution", "plates", "Quadrilateral", plates)
    return labels


def entry(value, unit, meaning, reference=None):
    """One result of summary.json."""
    result = {"value": value, "unit": unit, "meaning": meaning}
    if reference is not None:
        result["reference"] = reference
        result["error"] = value / reference - 1.0
    return result


def write_summary(folder, **more):
    """summary.json of a stroke on a peanut."""
    document = {
        "peak_occlusal_force": entry(10.15, "N", "largest normal force on the "
                                     "upper plate"),
        "occlusal_force_time_of_peak": entry(0.0068, "s", "when it occurred"),
        "compressive_strength": entry(101.5e3, "Pa", "peak nominal axial "
                                      "stress", STRENGTH),
        "masticatory_performance": entry(1.31, "1/sqrt(mm)", "T4-4 with the "
                                         "largest fragment"),
        "masticatory_performance_all_fragments": entry(
            1.46, "1/sqrt(mm)", "T4-4 with all fragments"),
        "fragment_count": entry(18, "1", "fragments of at least 0.5 % of the "
                                "mass"),
        "largest_fragment_share": entry(0.142, "1", "mass share of the "
                                        "largest fragment"),
        "failed_share": entry(0.27, "1", "mass share that has failed"),
        "strain_at_peak": entry(0.068, "1", "nominal strain at the peak"),
        "nominal_stiffness": entry(1.52e6, "Pa", "slope of the rise"),
        "strain_from_peak_to_half": entry(0.008, "1", "of the fall"),
        "residual_strength": entry(9e3, "Pa", "of the last part"),
        "fracture_angle": entry(24.0, "degrees", "against the loading"),
        "fracture_sharpness": entry(0.31, "1", "of the direction"),
        "fragment_median_size": entry(2.4e-3, "m", "half of the mass is "
                                      "finer"),
        "complete_failure": entry(1, "1", "1 if the criterion was met"),
        "energy_balance_error": entry(0.024, "1", "closing error at the end"),
        "energy_balance_error_at_peak": entry(0.0021, "1", "closing error at "
                                              "the peak"),
        "kinetic_over_strain_energy_before_peak": entry(
            0.07, "1", "just before the peak"),
        "momentum_error": entry(2.3e-13, "1", "unexplained change of momentum"),
        "particle_count": entry(10201, "1", "particles"),
        "step_count": entry(8123, "1", "time steps"),
        "wall_time": entry(9.8, "s", "whole run"),
        "wall_time_loop": entry(8.9, "s", "time loop"),
        "particle_steps_per_second": entry(9.3e6, "1/s", "speed"),
        "peak_memory": entry(184e6, "B", "resident"),
        "effects": [
            {"name": "damage", "on": True, "reason": "the scene asks for it",
             "wall_time": 1.1},
            {"name": "contact", "on": True, "reason": "a plate can touch the "
             "food", "wall_time": 0.7},
            {"name": "artificial viscosity", "on": True,
             "reason": "auto: fracture sends waves", "wall_time": 1.6},
            {"name": "artificial stress", "on": False,
             "reason": "total Lagrangian: not needed", "wall_time": 0.0}],
        "parts": [{"name": "set-up", "wall_time": 0.6},
                  {"name": "pair loops", "wall_time": 5.2},
                  {"name": "output", "wall_time": 0.9}],
        "text": {"title": "Roasted peanut, one chewing stroke",
                 "program": "Morsel 0.1.0", "deal_ii": "9.4.1",
                 "parameters_hash": "9f2c41d7"}}
    document.update(more)
    (folder / "summary.json").write_text(json.dumps(document, indent=2),
                                         encoding="utf-8")


def write_run(folder, across=101):
    """A complete run."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    labels = write_fields(folder, across)
    write_history(folder)
    write_summary(folder)
    sizes = np.bincount(labels[labels >= 0]) / len(labels)
    with open(folder / "fragments.csv", "w", encoding="utf-8") as stream:
        stream.write("fragment [1],mass_share [1],area [mm^2],"
                     "perimeter [mm]\n")
        for k, share in enumerate(sizes):
            stream.write(f"{k},{share},{100 * share},"
                         f"{4.6 * np.sqrt(100 * share)}\n")
    (folder / "used.prm").write_text("set Title = peanut\n", encoding="utf-8")


if __name__ == "__main__":
    import sys

    write_run(sys.argv[1])
