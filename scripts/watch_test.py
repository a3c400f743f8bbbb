#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Feeds `skysweep watch` as the world does: the map must come out as a `run` over everything makes it.

  scripts/watch_test.py --program build/release/skysweep --photographs 200 --looks 50

Simulated photographs are copied into a watched folder in random order and at random pace: under another name and
renamed, at once, or in pieces; some are cut off at first and completed later, some are sent twice, some are broken for
ever. A third of the poses is there before, a third is appended to poses.csv as a logger does it, half lines included,
and a third comes late, some in files beside the photographs. Meanwhile the watcher is stopped (SIGTERM), killed
(SIGKILL) and told to reload (SIGHUP), and at random moments somebody looks at the map: the virtual mosaics must open
and every cell of them be readable, every tile of every level too, and `info` must answer. In the end every tile, mosaic
and virtual mosaic must be equal, byte by byte, to those of a `run` with the same project.toml, and quarantine.csv must
name what was broken and nothing else.

The order and the ways come from a fixed seed; what the looks hit depends on the machine, the result must not.
"""
import argparse
import csv
import json
import math
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

SCENE = """
seed = 5
area_m = [{side}, {side}]
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
SQUARE_METRES_A_PHOTOGRAPH = 3.6 * 6.4   # of the overlaps above
MARGIN_M = 5                             # that no photograph is taken in
MAP_OPTIONS = ["--cell=0.1", "--dz=0.05", "--z-range=-2,5", "--threads=2"]
COMPARED = (".tif", ".vrt", ".png", ".toml")
PATIENCE_S = 400


class Watcher:
    """`skysweep watch` as a child."""

    def __init__(self, command, log):
        self.command, self.log = command, log
        self.start()

    def start(self):
        with open(self.log, "ab") as log:
            self.process = subprocess.Popen(self.command, stdout=log, stderr=log)

    def stop(self):
        """As systemd does; the watcher must end well."""
        self.process.send_signal(signal.SIGTERM)
        code = self.process.wait(timeout=60)
        if code != 0:
            raise SystemExit(f"after SIGTERM the watcher ended with {code}: {self.last_words()}")

    def kill(self):
        self.process.kill()
        self.process.wait()

    def require_alive(self):
        if self.process.poll() is not None:
            raise SystemExit(f"the watcher ended with {self.process.returncode}: {self.last_words()}")

    def last_words(self):
        with open(self.log, encoding="utf-8", errors="replace") as log:
            return "".join(log.readlines()[-10:])


class Sender:
    """Brings photographs and poses into the folder, as its chance has it."""

    def __init__(self, flight, folder, chance):
        self.images, self.folder, self.chance = os.path.join(flight, "images"), folder, chance
        with open(os.path.join(flight, "poses.csv"), encoding="utf-8", newline="") as file:
            self.header, *rows = file.read().splitlines()
        self.row_of = {row.split(",")[0]: row for row in rows}
        self.names = sorted(self.row_of)
        self.lock = threading.Lock()   # of poses.csv

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)

    def append_pose(self, row):
        """In two pieces, with time to read between them."""
        with self.lock, open(self.path("poses.csv"), "a", encoding="utf-8") as file:
            middle = self.chance.randrange(len(row))
            for part in (row[:middle], row[middle:] + "\n"):
                file.write(part)
                file.flush()
                time.sleep(self.chance.uniform(0, 0.02))

    def send_pose_beside(self, name):
        stem = os.path.splitext(name)[0]
        row = self.row_of[name]
        if self.chance.random() < 0.5:
            self.write(stem + ".csv", f"{self.header}\n{row}\n".encode())
        else:
            pairs = list(zip(self.header.split(","), row.split(",")))
            texts = [f'"{key}": ' + (f'"{value}"' if key == "image" else value) for key, value in pairs]
            self.write(stem + ".json", ("{" + ", ".join(texts) + "}").encode())

    def send_photograph(self, name):
        with open(os.path.join(self.images, name), "rb") as file:
            data = file.read()
        way = self.chance.choice(["renamed", "at once", "in pieces"])
        if way == "renamed":
            self.write(name + ".part", data)
            os.rename(self.path(name + ".part"), self.path(name))
        elif way == "at once":
            self.write(name, data)
        else:
            with open(self.path(name), "wb") as file:
                for at in range(0, len(data), 1 + len(data) // 4):
                    file.write(data[at:at + 1 + len(data) // 4])
                    file.flush()
                    time.sleep(0.02)

    def send_cut_off(self, name):
        with open(os.path.join(self.images, name), "rb") as file:
            data = file.read()
        self.write(name, data[:self.chance.randrange(1, len(data))])

    def send_broken(self, count):
        """Photographs with poses that nobody will ever complete, and files that are none of the watcher's."""
        broken = []
        for i in range(count):
            name = f"broken {i}, \"{i}\".jpg"
            like = self.names[i % len(self.names)]
            with open(os.path.join(self.images, like), "rb") as file:
                data = file.read()
            self.write(name, [data[:len(data) // 2], b"", b"a text", data[:200] + bytes(len(data) - 200)][i % 4])
            broken.append(name)
        self.write("notes.txt", b"a text")
        self.write("half.jpg.part", b"\xff\xd8\xff")
        return broken

    def jobs(self):
        """What is to be done, in order: (when, function, argument); `when` counts photographs."""
        count = len(self.names)
        jobs = []
        for name in self.names:
            when = self.chance.uniform(0, count)
            if self.chance.random() < 0.15:
                jobs.append((when, self.send_cut_off, name))
                when += self.chance.uniform(1, count / 3)
            jobs.append((when, self.send_photograph, name))
            if self.chance.random() < 0.15:
                jobs.append((when + self.chance.uniform(0, count / 3), self.send_photograph, name))
            third = self.chance.randrange(3)
            if third == 0:
                jobs.append((-1, self.append_pose, self.row_of[name]))
            elif third == 1:
                jobs.append((when, self.append_pose, self.row_of[name]))
            elif self.chance.random() < 0.5:
                jobs.append((when + count / 2, self.append_pose, self.row_of[name]))
            else:
                jobs.append((when + count / 2, self.send_pose_beside, name))
        return sorted(jobs, key=lambda job: job[0])


def read_every_cell(path):
    """Why GDAL cannot read the raster to its last cell; None if it can."""
    done = subprocess.run(["gdalinfo", "-checksum", path], capture_output=True, text=True, check=False)
    trouble = [line for line in done.stderr.splitlines() if "ERROR" in line]
    return trouble[0] if trouble or done.returncode != 0 else None


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def require_metrics(port):
    """Prometheus must get an answer at any time but while the watcher starts."""
    for _ in range(50):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/metrics", timeout=5) as answer:
                text = answer.read().decode()
            break
        except OSError:
            time.sleep(0.1)
    else:
        raise SystemExit("nobody answers on the port for metrics")
    if "\nskysweep_watch_photographs{state=\"mapped\"} " not in text:
        raise SystemExit(f"metrics without photographs: {text}")


def look_at(program, project):
    """Whether there was something to see; ends the test if it could not be seen."""
    for name in ("dsm.vrt", "ortho.vrt"):
        path = os.path.join(project, name)
        for _ in range(3):
            if not os.path.exists(path):
                return False
            before = os.stat(path).st_ino
            trouble = read_every_cell(path)
            # One that was replaced while it was read may have named a tile that is gone.
            if trouble is None or (os.path.exists(path) and os.stat(path).st_ino == before):
                break
        if trouble:
            raise SystemExit(f"{path} cannot be read: {trouble}")
    tiles = [os.path.join(folder, name) for folder, _, names in os.walk(os.path.join(project, "tiles"))
             for name in names if name.endswith(".tif") and ".skysweep-part" not in name]
    coarse = [tile for tile in tiles if "/l0/" not in tile]
    for tile in coarse[:12]:
        trouble = read_every_cell(tile)
        if trouble and os.path.exists(tile):
            raise SystemExit(f"the tile {tile} cannot be read: {trouble}")
    info = subprocess.run([program, "info", project], capture_output=True, text=True, check=False)
    if info.returncode != 0:
        raise SystemExit(f"info of {project}: {info.stderr}")
    return True


def status_of(root):
    with open(os.path.join(root, "status.json"), encoding="utf-8") as file:
        return json.load(file)


def wait_until(watcher, root, condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        watcher.require_alive()
        if os.path.exists(os.path.join(root, "status.json")) and condition(status_of(root)):
            return
        time.sleep(0.2)
    raise SystemExit(f"{what} did not come: {status_of(root)}")


def contents(project):
    found = {}
    for folder, _, files in os.walk(project):
        for name in files:
            path = os.path.join(folder, name)
            if ".skysweep-part" in name:
                found[path[len(project):]] = "left behind"
            elif name.endswith(COMPARED):
                with open(path, "rb") as file:
                    found[path[len(project):]] = file.read()
    return found


def quarantined(root):
    with open(os.path.join(root, "quarantine.csv"), encoding="utf-8", newline="") as file:
        return {row["file"]: row["reason"] for row in csv.DictReader(file)}


def feed(sender, watcher, program, root, looks, chance, pace_s, port):
    """All jobs, with looks, a stop, a kill and a reload at random places between them. Returns how many looks saw
    something."""
    jobs = sender.jobs()
    looking = chance.choices(range(len(jobs) // 3, len(jobs)), k=looks)  # before there is little to see
    stopping, killing, reloading = chance.sample(range(len(jobs) // 4, 3 * len(jobs) // 4), 3)
    seen = 0
    for i, (_, act, argument) in enumerate(jobs):
        act(argument)
        time.sleep(chance.uniform(0, 2 * pace_s))
        watcher.require_alive()
        for _ in range(looking.count(i)):
            seen += look_at(program, os.path.join(root, "map"))
            require_metrics(port)
        if i == reloading:
            watcher.process.send_signal(signal.SIGHUP)
        if i == stopping:
            watcher.stop()
            watcher.start()
        if i == killing:
            watcher.kill()
            watcher.start()
    return seen


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--photographs", type=int, default=24, help="about so many")
    parser.add_argument("--looks", type=int, default=10)
    parser.add_argument("--pace", type=float, default=0.1, help="seconds between two things sent, on average")
    parser.add_argument("--poll", type=float, help="let the watcher poll, so many seconds apart")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    chance = random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix="watch_test.") as folder:
        def path(name):
            return os.path.join(folder, name)
        side = math.sqrt(options.photographs * SQUARE_METRES_A_PHOTOGRAPH) + MARGIN_M
        for name, text in (("scene.toml", SCENE.format(side=round(side, 1))), ("small_tiles.toml", SMALL_TILES),
                           ("watch.toml", "[watch]\nfirst = 4\n")):
            with open(path(name), "w", encoding="utf-8") as file:
                file.write(text)
        subprocess.run([program, "simulate", path("scene.toml"), "-o", path("flight")], check=True,
                       stdout=subprocess.DEVNULL)
        os.mkdir(path("incoming"))
        sender = Sender(path("flight"), path("incoming"), chance)
        with open(sender.path("poses.csv"), "w", encoding="utf-8") as file:
            file.write(sender.header + "\n")
        map_options = MAP_OPTIONS + ["--config", path("small_tiles.toml")]
        port = free_port()
        command = [program, "watch", path("incoming"), "-o", path("maps"), "--settings", path("watch.toml"),
                   "--metrics", str(port)] + map_options
        if options.poll:
            command += ["--poll", str(options.poll)]
        watcher = Watcher(command, path("watch.log"))
        broken = sender.send_broken(4)
        for name in broken:
            quoted = '"' + name.replace('"', '""') + '"'
            sender.append_pose(quoted + "," + sender.row_of[sender.names[0]].split(",", 1)[1])
        seen = feed(sender, watcher, program, path("maps"), options.looks, chance, options.pace, port)
        count = len(sender.names)
        wait_until(watcher, path("maps"), lambda s: s["mapped"] == count and s["due"] == 0 and s["arriving"] == 0,
                   f"the map of {count} photographs")
        wait_until(watcher, path("maps"), lambda _: os.path.exists(path("maps/map/preview.png")), "the mosaics")
        status = status_of(path("maps"))
        watcher.stop()
        look_at(program, path("maps/map"))

        os.mkdir(path("batch"))
        shutil.copy(path("maps/map/project.toml"), path("batch"))
        subprocess.run([program, "run", path("flight/images"), "--poses", path("flight/poses.csv"), "-o", path("batch")] +
                       map_options, check=True, stdout=subprocess.DEVNULL)
        expected, actual = contents(path("batch")), contents(path("maps/map"))
        different = sorted(name for name in expected.keys() | actual.keys() if expected.get(name) != actual.get(name))
        if different:
            print(f"{len(different)} files differ from those of a run:", *different[:20], sep="\n  ")
            return 1
        reasons = quarantined(path("maps"))
        if sorted(reasons) != sorted(broken) or not all(reasons.values()):
            print(f"In quarantine: {reasons}, broken were {broken}")
            return 1
        print(f"{count} photographs: {len(expected)} files as a run makes them, byte for byte; {len(broken)} broken ones in "
              f"quarantine; the map could be read in each of {seen} looks (of {options.looks}, the others before it began).")
        print(f"Median time from a complete photograph with its pose to its tiles on disk, since the last start: "
              f"{status.get('median_seconds_to_tiles', float('nan')):.2f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
