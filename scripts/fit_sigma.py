#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Fits the parameters of src/sweep/sigma_parameters.h to scenes with exact truth, and prints them.

Simulates the training scenes, maps them, dumps the signs of every tile (`skysweep sweep --dump`), and looks for the
parameters with which one sigma and 1.96 sigma cover the shares of the errors that they promise: overall, in each tenth
of the cells by sigma, and on ground, roofs and trees each alone. A deterministic evolution (seeds below); what is
covered afterwards is printed scene by scene, test scenes behind the training ones. Needs python3-numpy, python3-gdal.

Usage: scripts/fit_sigma.py [--program build/release/skysweep] [--work FOLDER] [--steps N] [--test SCENE:PRESET ...]
FOLDER keeps flights and dumps between calls; a dump that is there is not made again.
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

import numpy as np
from osgeo import gdal

gdal.UseExceptions()
ROOT = pathlib.Path(__file__).resolve().parent.parent
TRAINING = ["dense_town_small:balanced", "dense_town_small:fast", "gable_roofs:balanced", "gable_roofs:accurate",
            "quarry:balanced", "forest_edge:balanced", "forest_edge:fast", "fractal_hills:balanced", "hamlet:balanced",
            "hamlet:accurate"]
TESTS = ["small_town:balanced", "infrastructure:balanced"]
SIGNS = ["height_per_pixel", "step_5", "step_17", "offset", "excess_3", "excess_9", "undecided", "bend_9", "cost_9",
         "cost_17"]
EDGE_SIGNS = ["edge_margin", "edge_difference"]  # NaN where the colours at a step were not asked
CLASSES = {1: "ground", 2: "roof", 4: "tree"}
BEST = 0.07  # kBestPixels of sigma_parameters.h
FEWEST_CELLS = 150  # of a class that is judged alone
TRAINED_CELLS = 12000  # of each scene, every n-th
SEEDS = (1, 2)

# Where the search begins, in the order of sigma_parameters.h: level, step, offset, excess, bend, cost | level, cost, undecided | level, cost, undecided |
# at edges: level, difference, margin | level, difference, undecided, excess | level.
START = [-0.531, 0.414, 0.166, -0.439, -0.411, -1.014, 0.632, 3.826, 1.121, -0.674, 0.279, 0.28,
         -0.224, -0.151, -0.315, 0.639, 3.901, -1.186, 1.963, -0.526]
STEP = [0.1, 0.05, 0.03, 0.1, 0.08, 0.15, 0.2, 0.5, 0.4, 0.15, 0.3, 0.5, 0.15, 0.15, 0.08, 0.4, 0.4, 0.5, 0.3, 0.2]

# Where coverage should lie, of one sigma and of 1.96: overall, and in each part; narrower than the bars of the tests.
ALL_68, ALL_95 = (0.67, 0.73), (0.94, 0.97)
PART_68, PART_95 = (0.60, 0.79), (0.91, 0.985)


def scene_file(name):
    example = ROOT / "config" / "scenes" / f"{name}.toml"
    return example if example.exists() else ROOT / "tests" / "accuracy" / "scenes" / f"{name}.toml"


def read(path):
    data = gdal.Open(str(path))
    return data.ReadAsArray(), data.GetGeoTransform()


def call(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def dump(program, work, scene, preset):
    """Folder with a dump of each tile of the scene mapped with the preset; and the flight."""
    flight, out = work / "flights" / scene, work / f"{scene}-{preset}"
    if not flight.exists():
        call(program, "simulate", scene_file(scene), "-o", flight)
    if not out.exists():
        cell = read(flight / "truth" / "dsm.tif")[1][1]
        project = out / "project"
        call(program, "run", flight / "images", "--poses", flight / "poses.csv", "-o", project, "--cell", f"{cell:g}",
             "--preset", preset)
        for tile in sorted((project / "tiles" / "dem" / "l0").glob("x*/y*.tif")):
            name = f"l0{tile.parent.name}{tile.stem}"
            call(program, "sweep", project, "--tile", name, "--dump", out / name)
    return flight, out


def number(project, key):
    return float(re.search(rf"^{key} = (.*)$", (project / "project.toml").read_text(), re.M).group(1))


def on_grid(values, transform, shape, grid, fill):
    """`values` moved onto a grid of the same cells; `fill` where they say nothing."""
    column = round((grid[0] - transform[0]) / transform[1])
    row = round((transform[3] - grid[3]) / transform[1])
    out = np.full(shape, fill, dtype=values.dtype)
    top, left = max(0, row), max(0, column)
    bottom, right = min(values.shape[0], row + shape[0]), min(values.shape[1], column + shape[1])
    if bottom > top and right > left:
        out[top - row:bottom - row, left - column:right - column] = values[top:bottom, left:right]
    return out


def cells_of(flight, out):
    """Errors, classes and signs of all measured cells; heights in units of the height that is worth a pixel."""
    project = out / "project"
    collar, dz = int(number(project, "collar_cells")), number(project, "dz_m")
    truth, truth_grid = read(flight / "truth" / "dsm.tif")
    classes, _ = read(flight / "truth" / "classes.tif")
    parts = []
    for tile in sorted(t for t in out.iterdir() if t.name.startswith("l0")):
        height, grid = read(tile / "height.tif")
        known = np.zeros(height.shape, bool)
        known[collar:-collar, collar:-collar] = True
        dsm = on_grid(truth, truth_grid, height.shape, grid, np.nan)
        known &= np.isfinite(height) & np.isfinite(dsm) & (np.abs(dsm) < 1e30) & (read(tile / "filled.tif")[0] == 0)
        layers = {s: read(tile / f"{s}.tif")[0][known].astype(float) for s in SIGNS}
        for s in EDGE_SIGNS:
            if not (tile / f"{s}.tif").exists():  # nobody looked
                layers[s] = np.full(known.sum(), np.nan)
                continue
            values = read(tile / f"{s}.tif")[0][known].astype(float)
            layers[s] = np.where(np.abs(values) < 1e30, values, np.nan)
        layers["error"] = np.abs(height[known].astype(float) - dsm[known])
        layers["class"] = on_grid(classes, truth_grid, height.shape, grid, 0)[known]
        parts.append(layers)
    c = {k: np.concatenate([p[k] for p in parts]) for k in parts[0]}
    unit = np.where(np.isnan(c["height_per_pixel"]), dz, c["height_per_pixel"])
    return {
        "error": c["error"] / unit, "class": c["class"],
        "doubtless": np.stack([np.ones(len(unit)), np.log(0.05 + c["step_5"] / unit),
                               np.log(0.01 + c["offset"] / unit), (np.minimum(c["excess_9"], 18) - 12) / 10,
                               np.log(np.maximum(c["bend_9"], 1e-3) * unit / dz),
                               np.log(np.maximum(c["cost_9"], 1e-3) / 3)]),
        "excess": np.log(0.2 + c["excess_3"]),
        "doubtful": np.stack([np.ones(len(unit)), np.log(np.maximum(c["cost_17"], 1e-3) / 3), c["undecided"]]),
        "at_edge": np.isfinite(c["edge_margin"]), "margin": c["edge_margin"],
        "edge": np.stack([np.ones(len(unit)), np.log(np.maximum(c["edge_difference"], 0.3)),
                          np.clip(c["edge_margin"], 0, 4), c["undecided"]]),
        "step": np.log(np.maximum(1, c["step_17"] / unit)), "unit": unit,
    }


def every_nth(cells, count):
    n = max(1, len(cells["error"]) // count)
    return {k: v[..., ::n] for k, v in cells.items()}


def sigma(cells, p):
    sure = np.maximum(np.log(BEST), p[0:6] @ cells["doubtless"])
    is_doubtful = cells["excess"] < p[6:9] @ cells["doubtful"]
    doubtful = np.maximum(sure, p[9:12] @ cells["doubtful"] + cells["step"])
    of_edge = np.maximum(np.log(BEST), p[12:15] @ cells["edge"][0:3])
    is_either = (cells["margin"] < p[15:18] @ cells["edge"][[0, 1, 3]]) & (cells["excess"] < p[18])
    of_edge = np.where(is_either, np.maximum(of_edge, p[19] + cells["step"]), of_edge)
    return np.exp(np.where(cells["at_edge"], of_edge, np.where(is_doubtful, doubtful, sure)))


def coverage(cells, p):
    """(name, share within one sigma, within 1.96): all, tenths by growing sigma, classes."""
    s, e = sigma(cells, p), cells["error"]

    def of(name, part):
        return name, np.mean(e[part] <= s[part]), np.mean(e[part] <= 1.96 * s[part])

    rows = [of("all", slice(None))]
    order = np.argsort(s * cells["unit"], kind="stable")
    rows += [of(f"tenth {i}", part) for i, part in enumerate(np.array_split(order, 10))]
    for code, name in CLASSES.items():
        part = cells["class"] == code
        if part.sum() >= FEWEST_CELLS:
            rows.append(of(name, part))
    return rows


def miss(value, bounds):
    return max(0, bounds[0] - value, value - bounds[1])


def loss(scenes, p):
    total = 0
    for cells in scenes:
        for name, in_68, in_95 in coverage(cells, p):
            weight, b68, b95 = (3, ALL_68, ALL_95) if name == "all" else (1, PART_68, PART_95)
            total += weight * ((15 * miss(in_68, b68)) ** 2 + (25 * miss(in_95, b95)) ** 2)
            total += 0.05 * (25 * (in_68 - 0.69) ** 2 + 100 * (in_95 - 0.945) ** 2)
    return total / len(scenes)


def evolve(scenes, steps, seed):
    random, best, reach = np.random.RandomState(seed), np.array(START), 1.0
    least = loss(scenes, best)
    for _ in range(steps):
        moved = random.rand(len(best)) < 0.35
        tried = best + random.randn(len(best)) * np.array(STEP) * reach * moved
        value = loss(scenes, tried)
        if value < least:
            least, best, reach = value, tried, min(1.5, 1.3 * reach)
        else:
            reach = max(0.05, 0.985 * reach)
    return least, best


def print_coverage(case, cells, p):
    s = sigma(cells, p) * cells["unit"]
    rows = " ".join(f"{name.replace('tenth ', '')} {100 * a:.0f}/{100 * b:.0f}" for name, a, b in coverage(cells, p))
    print(f"{case:26} median sigma {np.median(s):.4f} m, within 1 / 1.96 sigma, %: {rows}", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "skysweep")
    arguments.add_argument("--work", type=pathlib.Path)
    arguments.add_argument("--steps", type=int, default=600)
    arguments.add_argument("--test", nargs="*", default=TESTS)
    arguments.add_argument("--parameters", type=float, nargs=20, help="show what these cover, and fit nothing")
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = options.work or pathlib.Path(temporary)
        load = lambda case: cells_of(*dump(options.program, work, *case.split(":")))
        training = {} if options.parameters else {case: load(case) for case in TRAINING}
        p = np.array(options.parameters) if options.parameters else None
        if p is None:
            sample = [every_nth(cells, TRAINED_CELLS) for cells in training.values()]
            least, p = min((evolve(sample, options.steps, seed) for seed in SEEDS), key=lambda found: found[0])
            p = np.round(p, 3)
            print(f"loss {least:.3f}")
            for name, part in (("kSigmaOfDoubtless", p[0:6]), ("kDoubt", p[6:9]), ("kSigmaOfDoubtful", p[9:12]),
                               ("kSigmaOfEdges", p[12:15]), ("kEdgeDoubt", p[15:19]), ("kEdgeStep", p[19:20])):
                print(f"{name} = {{{', '.join(f'{x:g}' for x in part)}}};")
        for case, cells in training.items():
            print_coverage(case, cells, p)
        for case in options.test:
            print_coverage(case + " (test)", load(case), p)


if __name__ == "__main__":
    main()
