#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What each fault of photographs, poses and light costs in accuracy: turns the dials of a small town one by one.

Usage: scripts/fault_dials.py [--only NAME]... [--program PATH] [--keep FOLDER] [--out FILE]

Each dial has three strengths. Each strength is simulated, mapped with the preset `fast` and compared with the exact
truth; the table goes to docs/fault-dials.md (with --only: to the terminal, unless --out says otherwise). All figures but
those of time are the same in every call. Needs nothing but Python 3.11 and a built program. Ends with 1 if a strength
could not be measured.
"""
import argparse
import csv
import dataclasses
import datetime
import json
import os
import pathlib
import platform
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
BASE = "config/scenes/fault_dials.toml"
GSD_M, CELL_M = 0.05, 0.1
HEIGHTS_M = "-3,14"  # holds the town and spares each of the runs the search for the ground
STRENGTHS = ("mild", "plain", "strong")
GROUPS = {
    "metadata": "What the files say about poses and camera",
    "rays": "Lens and shutter",
    "light": "Light and what moves",
    "image": "Air and sensor",
    "place": "Ground, texture and flight",
}


@dataclasses.dataclass
class Dial:
    """A fault at three strengths: what to write over the base scene for each."""
    name: str
    group: str
    labels: tuple                # of the strengths, with units
    changes: tuple               # for each strength {"table.key": value}
    effect: str = ""             # name of the effect it belongs to; empty: no effect
    given: dict = dataclasses.field(default_factory=dict)  # {"table.key": value} of its own undisturbed scene, too
    hide_distortion: bool = False  # poses.csv says that the lens has none
    note: str = ""


def of_effect(effect, key, unit, values, group, note="", given=None, **others):
    """A dial of [effects.EFFECT]; `others` are further keys, the same at each strength."""
    changes = tuple({f"effects.{effect}.{k}": v for k, v in {key: value, **others}.items()} for value in values)
    return Dial(f"{effect}.{key}", group, labels_of(values, unit), changes, effect, given or {}, note=note)


def of_scene(key, unit, values, group, note="", **more):
    return Dial(key, group, labels_of(values, unit), tuple({key: value} for value in values), note=note, **more)


def labels_of(values, unit):
    return tuple(f"{value} {unit}".strip() for value in values)


DIALS = [
    of_effect("pose_error", "position_sigma_m", "m", (0.01, 0.03, 0.1), "metadata"),
    of_effect("pose_error", "position_drift_m", "m", (0.02, 0.1, 0.5), "metadata",
              "Neighbours err alike, strips among each other do not: strips disagree by the whole drift."),
    of_effect("pose_error", "angle_sigma_deg", "deg", (0.01, 0.05, 0.2), "metadata"),
    of_effect("time_jitter", "sigma_s", "s", (0.001, 0.005, 0.02), "metadata"),
    Dial("camera.distortion, untold", "metadata", labels_of((0.003, 0.012, 0.05), "k1"),
         tuple({"camera.distortion": [k1, 0, 0, 0, 0]} for k1 in (0.003, 0.012, 0.05)), hide_distortion=True,
         note="0.5, 2 and 8 pixels in the corners, of which `poses.csv` knows nothing. The surface becomes a dome: a bias, "
              "hardly noise."),

    of_effect("rolling_shutter", "readout_s", "s", (0.01, 0.03, 0.08), "rays",
              "Rows are read along the flight, so that the image is stretched as if by another focal "
              "length: a bias first."),
    of_effect("motion_blur", "exposure_s", "s", (0.002, 0.006, 0.02), "rays",
              "0.3, 1 and 3 pixels at 8 m/s. Nearly nothing is lost: cells are two pixels wide, texture has detail at all "
              "scales, and all photographs of a strip are blurred alike. The time goes into the 4 to 64 rays of a pixel."),
    of_effect("defocus", "focus_distance_m", "m", (5, 2, 1), "rays",
              "Through a lens 4 mm wide: discs of 0.4, 1.2 and 2.4 pixels. As cheap in accuracy as motion blur, and for "
              "the same reasons.", aperture_mm=4),
    Dial("chromatic_aberration", "rays", labels_of((0.5, 1.5, 4), "px"),
         tuple({"effects.chromatic_aberration.red_px": s, "effects.chromatic_aberration.blue_px": -s}
               for s in (0.5, 1.5, 4.0)), "chromatic_aberration",
         note="Red outside, blue inside. Luminance has more red than blue, so that it is enlarged: a bias of the height."),

    of_scene("light.sun_elevation_deg", "deg", (35, 22, 12), "light"),
    Dial("light.shadows", "light", ("off",), ({"light.shadows": False},),
         note="With shadows 50 % of the building edges are found, without 79 %: probably because the dark ground beside a "
              "wall shows little to match."),
    of_effect("sky", "strength", "", (0.6, 0.3, 0.1), "light"),
    of_effect("sun_movement", "hours", "h", (0.5, 1.5, 4), "light"),
    of_effect("cloud_shadows", "cover", "", (0.2, 0.4, 0.6), "light", size_m=20),
    of_effect("moving_cars", "per_100m", "/ 100 m", (2, 6, 12), "light"),
    of_effect("specular_water", "wind_mps", "m/s", (1, 4, 8), "light", given={"terrain.water_level_m": -0.2}),

    of_effect("haze", "visibility_m", "m", (3000, 500, 100), "image"),
    of_effect("vignetting", "strength", "", (1, 2, 4), "image"),
    of_effect("exposure_drift", "stops", "stops", (0.1, 0.4, 1), "image",
              "Nothing is lost: matching normalises luminance locally. The same holds of white balance, `gain_spread` and "
              "vignetting."),
    of_effect("exposure_drift", "white_balance", "", (0.03, 0.1, 0.3), "image"),
    of_effect("sensor_noise", "iso", "ISO", (400, 1600, 6400), "image"),
    of_scene("photographs.noise_sigma", "grey levels", (2, 6, 15), "image"),
    of_scene("photographs.gain_spread", "", (0.05, 0.2, 0.5), "image"),
    of_scene("photographs.jpeg_quality", "", (80, 50, 20), "image"),

    of_scene("texture.contrast", "", (0.5, 0.2, 0.05), "place"),
    Dial("texture.kind = asphalt", "place", tuple(f"noise {n} grey levels" for n in (0, 2, 6)),
         tuple({"texture.kind": "asphalt", "photographs.noise_sigma": n} for n in (0, 2, 6)),
         note="Without noise the surface is carried over the bare ground from its surroundings; noise is something to "
              "match, wrongly."),
    Dial("texture.kind = tiles", "place", labels_of((4, 2, 1), "m"),
         tuple({"texture.kind": "tiles", "texture.period_m": p} for p in (4.0, 2.0, 1.0)),
         note="Cheap, because a wrong height would have to fit the tiles in all photographs, whose baselines differ."),
    Dial("flight overlap", "place", ("70 / 50 %", "60 / 35 %", "40 / 35 %"),
         tuple({"flight.along_overlap": a, "flight.across_overlap": b}
               for a, b in ((0.7, 0.5), (0.6, 0.35), (0.4, 0.35))),
         note="9, 6 and 4 photographs, along / across; measured where three of them see the cell, which are fewer cells."),
]

# Name, place in the JSON of `evaluate`, factor, unit, decimals.
FIGURES = [
    ("with a height", "masked.valid_share", 100, "%", 1),
    ("within 2 GSD", "masked.within_2_gsd.of_all", 100, "%", 1),
    ("median dz", "masked.median_gsd", 1, "GSD", 2),
    ("median abs dz", "masked.median_absolute_gsd", 1, "GSD", 2),
    ("LE90", "masked.le90_gsd", 1, "GSD", 1),
    ("edges F", "edges.all.scores.0.f_score", 1, "", 2),
    ("steps stand out", "edges.all.step_displacement.median_gsd", 1, "GSD", 1),
    ("ortho shift", "orthophoto.median_shift_cells", CELL_M / GSD_M, "GSD", 2),
]
LOSS = "within 2 GSD"  # what dials are ranked by


# --- scenes ---

def with_changes(scene, changes):
    """A copy of the scene, a dictionary of tables, with {"table.key": value} written over it."""
    out = json.loads(json.dumps(scene))
    for path, value in changes.items():
        *tables, key = path.split(".")
        table = out
        for name in tables:
            table = table.setdefault(name, {})
        table[key] = value
    return out


def to_toml(table, path=()):
    """Text of a dictionary of numbers, truth values, words, lists of them and tables."""
    def text_of(value):
        return json.dumps(value)  # of what scenes have, JSON writes the same as TOML

    values = [f"{key} = {text_of(value)}" for key, value in table.items() if not isinstance(value, dict)]
    head = ["", f"[{'.'.join(path)}]"] if path and values else []
    parts = ["\n".join(head + values)] if values else []
    parts += [to_toml(value, (*path, key)) for key, value in table.items() if isinstance(value, dict)]
    return "\n".join(part.rstrip("\n") for part in parts) + "\n"


def hide_distortion(poses_csv):
    """Makes poses.csv say that the lens has no distortion."""
    with open(poses_csv, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row.update({key: "0" for key in ("k1", "k2", "p1", "p2", "k3")})
    with open(poses_csv, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


# --- figures ---

def look_up(tree, path):
    """The number at "a.b.0.c" in nested dictionaries and lists, or None."""
    for key in path.split("."):
        if isinstance(tree, list):
            tree = tree[int(key)] if int(key) < len(tree) else None
        else:
            tree = tree.get(key) if isinstance(tree, dict) else None
    return tree


def figures_of(evaluation):
    """{name: number in its unit, or None}."""
    found = {name: (look_up(evaluation, path), factor) for name, path, factor, _, _ in FIGURES}
    return {name: None if value is None else factor * value for name, (value, factor) in found.items()}


def effects_of(explanation):
    """{effect: (calls, seconds)} of those that ran, from what `simulate --explain` prints."""
    lines = re.findall(r"^  (\w+) +(\w+) +(\d+) +(\d+\.\d+)  \S", explanation, re.MULTILINE)
    return {name: (int(calls), float(seconds)) for name, _, calls, seconds in lines}


def cell_text(value, reference, decimals):
    """"93.1 (-2.2)"; without the change for the undisturbed scene."""
    if value is None:
        return "-"
    text = f"{value:.{decimals}f}"
    if reference is None:
        return text
    change = round(value, decimals) - round(reference, decimals)
    return f"{text} ({change:+.{decimals}f})" if round(change, decimals) else f"{text} (0)"


@dataclasses.dataclass
class Measured:
    figures: dict
    cpu_s: float             # of simulate, all threads
    calls: int = 0           # of the dial's effect
    effect_s: float = 0      # in the effect, all threads


# --- measuring ---

class Failure(Exception):
    """A command that did not end with 0."""


class Bench:
    """Simulates, maps and measures scenes, each in a folder of its own."""

    def __init__(self, program, keep):
        self.program, self.keep = program, keep

    def measure(self, name, scene, effect="", untold_distortion=False):
        if self.keep:
            folder = self.keep / name
            folder.mkdir(parents=True, exist_ok=True)
            return self.measure_in(folder, scene, effect, untold_distortion)
        with tempfile.TemporaryDirectory(prefix="fault_dials_") as folder:
            return self.measure_in(pathlib.Path(folder), scene, effect, untold_distortion)

    def measure_in(self, folder, scene, effect, untold_distortion):
        (folder / "scene.toml").write_text(to_toml(scene), encoding="utf-8")
        flight, truth, project = folder / "flight", folder / "flight" / "truth", folder / "map"
        explanation, cpu_s = self.call("simulate", folder / "scene.toml", "-o", flight, "--explain")
        if untold_distortion:
            hide_distortion(flight / "poses.csv")
        self.call("run", flight / "images", "--poses", flight / "poses.csv", "-o", project, "--preset", "fast",
                  "--cell", CELL_M, f"--z-range={HEIGHTS_M}", "--fresh")
        self.call("evaluate", "--dsm", project / "dsm.tif", "--truth", truth / "dsm.tif", "--mask", truth / "views.tif",
                  "--mask-min", 3, "--gsd", GSD_M, "--ortho", project / "ortho.tif",
                  "--truth-ortho", truth / "ortho.tif", "--json", folder / "evaluation.json")
        evaluation = json.loads((folder / "evaluation.json").read_text(encoding="utf-8"))
        return Measured(figures_of(evaluation), cpu_s, *effects_of(explanation).get(effect, (0, 0)))

    def call(self, *arguments):
        """What the command prints, and the CPU time that it took."""
        command = [str(self.program), *map(str, arguments)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise Failure(f"{shlex.join(command)}\n  ended with {done.returncode}: {done.stderr.strip()}")
        return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def folder_name(dial, strength):
    return re.sub(r"[^\w.]+", "_", dial.name) + "-" + strength


def strengths_of(dial):
    return STRENGTHS if len(dial.labels) == len(STRENGTHS) else dial.labels


def measure_all(dials, base, bench, say):
    """[(dial, its undisturbed scene's Measured or None, a Measured or None for each strength)], and how many failed."""
    undisturbed, rows, failed = {}, [], 0

    def attempt(name, *arguments):
        nonlocal failed
        say(name)
        try:
            return bench.measure(name, *arguments)
        except Failure as problem:
            failed += 1
            say(f"{problem}\nAgain: scripts/fault_dials.py --only {shlex.quote(name)} --keep kept")
            return None

    for dial in dials:
        key = json.dumps(dial.given)
        scene = with_changes(base, dial.given)
        if key not in undisturbed:
            undisturbed[key] = attempt("undisturbed" if not dial.given else f"undisturbed for {dial.name}", scene)
        found = [attempt(folder_name(dial, strength), with_changes(scene, change), dial.effect, dial.hide_distortion)
                 for strength, change in zip(strengths_of(dial), dial.changes)]
        rows.append((dial, undisturbed[key], found))
    return rows, failed


# --- the page ---

def head_of_table():
    names = [f"{name}, {unit}" if unit else name for name, _, _, unit, _ in FIGURES]
    columns = ["dial", "strength", *names, "calls", "in the effect", "simulate"]
    return ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]


def row_of_table(name, label, measured, reference):
    if measured is None:
        return f"| {name} | {label} | failed |" + " |" * (len(FIGURES) + 2)
    cells = [cell_text(measured.figures[figure], reference.figures[figure] if reference else None, decimals)
             for figure, _, _, _, decimals in FIGURES]
    if measured.calls:
        share = 100 * measured.effect_s / measured.cpu_s
        cost = [str(measured.calls), f"{share:.0f} %" if share >= 0.5 else "< 1 %"]
    else:
        cost = ["", ""]
    cost.append(f"x {measured.cpu_s / reference.cpu_s:.1f}" if reference else f"{measured.cpu_s:.1f} CPU s")
    return "| " + " | ".join([name, label, *cells, *cost]) + " |"


def losses(rows, strength):
    """[(share lost, dial's name)] at a strength by its index, the largest loss first."""
    found = [(before.figures[LOSS] - after[strength].figures[LOSS], dial.name) for dial, before, after in rows
             if len(after) > strength and before and after[strength] and after[strength].figures[LOSS] is not None]
    return sorted(found, key=lambda loss: (-loss[0], loss[1]))


def page(rows, command, when, machine):
    first = next((before for dial, before, _ in rows if not dial.given), None)
    out = [
        "# What each fault costs",
        "",
        f"Made by `{command}` on {when},",
        f"{machine}. Not edited by hand: notes stand in the script, next to the dial.",
        "",
        f"A small town (`{BASE}`: 12 photographs of 640 x 480, GSD 5 cm) without any fault but those of its flight and of",
        "JPEG at quality 95, then with one dial at a time turned to three strengths: what a good survey still has, what is",
        f"common, what is bad. Each is mapped with the preset `fast`, cells of 10 cm and `--z-range={HEIGHTS_M}`, and compared with",
        "the exact truth where at least three photographs see the cell. In brackets the change against the undisturbed town.",
        "",
        "- *with a height*, *within 2 GSD*: shares of those cells; holes are misses. *dz* is measured minus true.",
        "- *edges F*: of building edges, found within 2 GSD (one cell). *Steps stand out*: how far walls stand out of their",
        "  true place, median. *Ortho shift*: of the orthophoto, median ([evaluation.md](evaluation.md)).",
        "- *calls* of the effect, for rows or photographs; *in the effect*: its part of the CPU time of `simulate`;",
        "  *simulate*: that CPU time as a multiple of the undisturbed town's, with the rays that the effect asks for. Times are",
        "  noisy, by a fifth or so, and say only what is cheap and what is not.",
        "",
    ]
    for index, strength in enumerate(STRENGTHS[1:], 1):
        worst = [f"`{name}` {loss:.1f}" for loss, name in losses(rows, index)[:6] if loss > 0.5]
        if worst:
            out += [f"Largest losses of *{LOSS}* at {strength} strength, in per cent of the cells: {', '.join(worst)}.", ""]
    if first:
        out += ["## Undisturbed", "", *head_of_table(), row_of_table("none", "", first, None), ""]
    for group, title in GROUPS.items():
        ours = [row for row in rows if row[0].group == group]
        if not ours:
            continue
        out += [f"## {title}", "", *head_of_table()]
        for dial, before, found in ours:
            if dial.given:
                out.append(row_of_table(f"none, for `{dial.name}`", "", before, None))
            for label, measured in zip(dial.labels, found):
                out.append(row_of_table(f"`{dial.name}`", label, measured, before))
        notes = [f"- `{dial.name}`: {dial.note}" for dial, _, _ in ours if dial.note]
        out += ["", *notes] if notes else []
        out.append("")
    return "\n".join(out)


def machine_text():
    cpu = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            cpu = line.split(":", 1)[1].strip()
    return f"{os.cpu_count()} cores, {cpu}"


def chosen_dials(only):
    """Dials that one of the words names, by name, effect or folder; all if there is no word. Throws ValueError."""
    if not only:
        return DIALS
    for word in only:
        if not any(matches(dial, word) for dial in DIALS):
            raise ValueError(f"--only {word}: no such dial; there are " + ", ".join(dial.name for dial in DIALS))
    return [dial for dial in DIALS if any(matches(dial, word) for word in only)]


def matches(dial, word):
    return word in (dial.effect, dial.name) or any(word == folder_name(dial, s) for s in strengths_of(dial))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", metavar="NAME", action="append", help="this dial or effect alone; may be repeated")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/skysweep")
    parser.add_argument("--keep", metavar="FOLDER", type=pathlib.Path, help="keep photographs and maps there")
    parser.add_argument("--out", metavar="FILE", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        dials = chosen_dials(arguments.only)
    except ValueError as error:
        parser.error(str(error))
    if not arguments.program.is_file():
        parser.error(f"{arguments.program} is not there: scripts/build.sh release skysweep")
    base = tomllib.loads((ROOT / BASE).read_text(encoding="utf-8"))
    rows, failed = measure_all(dials, base, Bench(arguments.program.resolve(), arguments.keep),
                               lambda text: print(text, file=sys.stderr, flush=True))
    command = shlex.join(["scripts/fault_dials.py", *(word for name in arguments.only or [] for word in ("--only", name))])
    text = page(rows, command, datetime.date.today().strftime("%-d %B %Y"), machine_text())
    out = arguments.out or (None if arguments.only else ROOT / "docs/fault-dials.md")
    if out:
        out.write_text(text, encoding="utf-8")
    else:
        print(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
