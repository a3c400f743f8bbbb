#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""From the classic sweep to the presets, rung by rung: what each part of the method brings and costs.

Simulates a scene, maps it with each configuration below, evaluates every cell of the truth (holes are misses), and
writes the table between the markers of docs/accuracy.md. Usage: scripts/ladder.py [SCENE.toml] [--program skysweep]
"""
import argparse
import json
import pathlib
import resource
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "accuracy.md"
BEGIN, END = "<!-- ladder: begin -->\n", "<!-- ladder: end -->\n"

CLASSIC = {
    "normalization_radius_px": 0, "normalization_tolerance": 0, "window_level_max": 0, "coarse_levels": 0,
    "aggregation": '"better-half"', "smoothing": '"none"', "few_views_penalty": 0.0, "max_cost_to_mean": 1.0,
    "follow_slopes": "false", "edge_contrast": 0.0, "visibility_passes": 0, "close_gap_cells": 0, "fill": "false",
    "edge_passes": 0, "compensate_exposure": "false",
}
# Each rung keeps what the ones above it changed.
RUNGS = [
    ("classic sums of absolute differences, one pixel, better half", CLASSIC),
    ("windows of 1 x 1 to 8 x 8 pixels", {"window_level_max": 3}),
    ("consensus, semi-global smoothing (P1 1, P2 8)",
     {"aggregation": '"consensus"', "smoothing": '"semi-global"', "large_step_penalty": 8.0}),
    ("local normalisation over 11 x 11 pixels", {"normalization_radius_px": 5}),
    ("over 5 x 5 pixels, windows of 1 and 2 pixels, P2 12",
     {"normalization_radius_px": 2, "window_level_max": 1, "large_step_penalty": 12.0}),
    ("by similar pixels only", {"normalization_tolerance": 80}),
    ("from coarse to fine", {"coarse_levels": 2, "max_cost_to_mean": 0.95}),
    ("smoothing along slopes", {"follow_slopes": "true"}),
    ("cheaper steps at edges of the picture", {"edge_contrast": 12.0}),
    ("views that see past the surface", {"visibility_passes": 1, "few_views_penalty": 1.5}),
    ("gaps filled", {"close_gap_cells": 128, "fill": "true"}),
    ("edges settled by the colours at the cell: `balanced`", {"edge_passes": 3}),
]
# Other costs in the last rung's place, each against it; patches need no normalised luminance.
PATCHES = {"normalization_radius_px": 0, "normalization_tolerance": 0, "window_level_max": 0}
OTHER_COSTS = [
    ("`balanced` with ZNCC of 5 x 5 cells", {**PATCHES, "cost": '"zncc"'}),
    ("`balanced` with ZNCC of 3 x 3 cells, P1 2, P2 20",
     {**PATCHES, "cost": '"zncc"', "patch_radius_cells": 1, "small_step_penalty": 2.0, "large_step_penalty": 20.0}),
    ("`balanced` with census of 5 x 5 cells", {**PATCHES, "cost": '"census"'}),
    ("`balanced` with census of 5 x 5 cells, P1 2, P2 20",
     {**PATCHES, "cost": '"census"', "small_step_penalty": 2.0, "large_step_penalty": 20.0}),
]


def run(command):
    """Runs quietly; returns wall and processor seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - start, after.ru_utime - before.ru_utime


def measured(program, flight, folder, options):
    """Figures of one map of the flight, made with the command line `options`."""
    wall, cpu = run([program, "run", flight / "images", "--poses", flight / "poses.csv", "-o", folder / "map", "--cell",
                     "0.1", "--fresh", *options])
    run([program, "evaluate", "--dsm", folder / "map/dsm.tif", "--truth", flight / "truth/dsm.tif", "--gsd", "0.05",
         "--classes", flight / "truth/classes.tif", "--json", folder / "figures.json"])
    figures = json.loads((folder / "figures.json").read_text())
    report = json.loads((folder / "map/report.json").read_text())
    return figures, report, wall, cpu


def row(name, figures, report, cpu):
    overall, edges = figures["overall"], figures["edges"]["buildings"]["scores"][0]
    return (f"| {name} | {100 * overall['within_2_gsd']['of_all']:.1f} % | {100 * overall['within_6_gsd']['of_all']:.1f} % "
            f"| {overall['median_absolute_gsd']:.2f} | {overall['le90_gsd']:.1f} | {edges['f_score']:.2f} "
            f"| {report['samples'] / 1e9:.1f} G | {cpu:.0f} s |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", type=pathlib.Path, default=ROOT / "config/scenes/dense_town_small.toml")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/skysweep")
    arguments = parser.parse_args()
    lines = ["| | within 2 GSD | within 6 GSD | median, GSD | LE90, GSD | edges of buildings, F at 2 GSD | samples | CPU |",
             "|---|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run([arguments.program, "simulate", arguments.scene, "-o", folder / "flight"])
        settings = {}
        rungs = [(rung, settings := {**settings, **changes}) for rung, changes in RUNGS]
        rungs += [(rung, {**settings, **changes}) for rung, changes in OTHER_COSTS]
        for rung, settings in rungs:
            (folder / "rung.toml").write_text("[sweep]\n" + "".join(f"{k} = {v}\n" for k, v in settings.items()))
            figures, report, _, cpu = measured(arguments.program, folder / "flight", folder,
                                               ["--config", folder / "rung.toml"])
            lines.append(row(rung, figures, report, cpu))
            print(lines[-1], flush=True)
        for preset in ("fast", "balanced", "accurate"):
            figures, report, _, cpu = measured(arguments.program, folder / "flight", folder, ["--preset", preset])
            lines.append(row(f"preset `{preset}`", figures, report, cpu))
            print(lines[-1], flush=True)
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    PAGE.write_text(before + BEGIN + "\n".join(lines) + "\n" + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
