#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills `skysweep run` at random moments and lets the next run go on: the map must come out as if nothing had happened.

  scripts/kill_test.py --program build/release/skysweep --kills 200

A third of the projects is begun from nothing, a third has a map of some of the photographs when the others arrive, and
from a third photographs are taken away. A run is killed (SIGKILL) after a random share of the time an undisturbed one takes, again and again, until one comes to its
end by itself. Then every tile of every layer, the mosaics and what the catalogue says of tiles and photographs are
compared with the undisturbed project's, byte by byte. The moments come from a fixed seed; what they hit depends on the
machine, the result must not. Exit code 0: all equal.
"""
import argparse
import collections
import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

SCENE = """
seed = 5
area_m = [14, 10]
[terrain]
relief_m = 0.5
[[building]]
center = [1, 0]
size_m = [4, 3]
roof_z_m = 3
[camera]
width_px = 320
height_px = 240
focal_px = 310
[flight]
gsd_m = 0.05
along_overlap = 0.7
across_overlap = 0.6
beyond_area_m = -3.5
"""
SMALL_TILES = "[tiles]\ncells = 64\ncollar_cells = 16\n"
COMPARED = (".tif", ".vrt", ".png", ".toml")
# Of the catalogue: not seconds, which differ, nor stamps, which are times.
QUERIES = ("SELECT name, level, digest, views, view_digests, candidates_digest, checksum, valid_share, z_low, z_high "
           "FROM tiles ORDER BY name",
           "SELECT name, status, digest, x, y, z FROM images ORDER BY name",
           "SELECT name, digest FROM products ORDER BY name")


class Flight:
    """A simulated flight, and runs over it."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.all = os.path.join(folder, "flight", "images")
        self.some = os.path.join(folder, "some")
        self.write("scene.toml", SCENE)
        self.write("small_tiles.toml", SMALL_TILES)
        subprocess.run([program, "simulate", self.path("scene.toml"), "-o", self.path("flight")], check=True,
                       stdout=subprocess.DEVNULL)
        os.mkdir(self.some)
        for name in sorted(os.listdir(self.all))[::2]:
            shutil.copy(os.path.join(self.all, name), self.some)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def command(self, images, project):
        return [self.program, "run", images, "--poses", os.path.join(self.folder, "flight", "poses.csv"), "-o", project,
                "--config", self.path("small_tiles.toml"), "--cell=0.1", "--dz=0.05", "--z-range=-2,5", "--threads=2",
                "--json-log"]

    def run(self, images, project):
        """Seconds that a run to its end took."""
        start = time.monotonic()
        done = subprocess.run(self.command(images, project), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              check=False)
        if done.returncode != 0:
            raise SystemExit(f"a run of {project} ended with {done.returncode}: {done.stderr.decode()}")
        return time.monotonic() - start

    def run_and_kill(self, images, project, seconds):
        """The stage the run was in when it was killed; None if it had come to its end."""
        with tempfile.TemporaryFile() as out:
            process = subprocess.Popen(self.command(images, project), stdout=out, stderr=subprocess.DEVNULL)
            try:
                code = process.wait(timeout=seconds)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                return last_stage(out)
        if code != 0:
            raise SystemExit(f"a run of {project} that nobody killed ended with {code}")
        return None


def last_stage(out):
    out.seek(0)
    stage = "before the first tile"
    for line in out.read().decode(errors="replace").splitlines():
        try:
            event = json.loads(line)
        except ValueError:
            continue  # cut off by the kill
        if event.get("event") == "progress":
            finished = event["done"] == event["total"]
            stage = ("after " if finished else "during ") + event["stage"]
    return stage


def contents(project):
    """Everything that must be equal, by name."""
    found = {}
    for folder, _, files in os.walk(project):
        for name in files:
            path = os.path.join(folder, name)
            if ".skysweep-part" in name:
                found[path[len(project):]] = "left behind"
            elif name.endswith(COMPARED):
                with open(path, "rb") as file:
                    found[path[len(project):]] = file.read()
    with sqlite3.connect(os.path.join(project, "catalog.gpkg")) as catalogue:
        for query in QUERIES:
            found[query] = catalogue.execute(query).fetchall()
    return found


def differences(expected, actual):
    return sorted(name for name in expected.keys() | actual.keys() if expected.get(name) != actual.get(name))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    stages = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="kill_test.") as folder:
        flight = Flight(os.path.abspath(options.program), folder)
        undisturbed = flight.path("undisturbed")
        seconds = flight.run(flight.all, undisturbed)
        some = flight.path("of_some")
        os.mkdir(some)
        shutil.copy(os.path.join(undisturbed, "project.toml"), some)
        flight.run(flight.some, some)
        # What is there at first, which photographs the runs are given, what must come out.
        kinds = ((None, flight.all, contents(undisturbed)), (some, flight.all, contents(undisturbed)),
                 (undisturbed, flight.some, contents(some)))
        killed = projects = 0
        while killed < options.kills:
            project = flight.path("project")
            shutil.rmtree(project, ignore_errors=True)
            before, images, expected = kinds[projects % len(kinds)]
            if before:
                shutil.copytree(before, project)
            projects += 1
            while killed < options.kills:
                stage = flight.run_and_kill(images, project, chance.uniform(0, 1.1 * seconds))
                if stage is None:
                    break
                killed += 1
                stages[stage] += 1
            flight.run(images, project)
            different = differences(expected, contents(project))
            if different:
                print(f"After {killed} kills project {projects} differs from the undisturbed one in:", *different[:20],
                      sep="\n  ")
                return 1
    print(f"{killed} kills in {projects} projects, all of which came out byte for byte as the undisturbed one.")
    for stage, count in sorted(stages.items()):
        print(f"  {count:4} {stage}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
