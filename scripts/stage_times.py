#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints where the processor time of a run went, stage by stage, as a table for docs/performance.md.

Usage: perf record -e cpu-clock -F 500 -o run.data build/release/skysweep run ... && scripts/stage_times.py run.data
"""
import re
import subprocess
import sys

# The first pattern that matches "library symbol" names the stage.
STAGES = [
    ("matching costs", r"fill_run|match_cells|match_cpu|bilinear"),
    ("smoothing", r"continue_paths|add_pass|path_costs|smooth"),
    ("best planes, heights between planes", r"best_planes|winner_of|find_least|find_rival|add_up_costs|costs_near_best|costs_around|refine_fractions|CostVolume|heights_from_matches|parabola"),
    ("horizons: which views see past the surface", r"Horizons"),
    ("slopes and edges for the smoothing", r"guide_image|expected_planes|expected_rise|lround"),
    ("search range, coarse to fine", r"narrow_search|coarse_surface|search_near|PlaneSet|spread"),
    ("evidence: views counted", r"ShownPlanes|drop_heights_without_evidence"),
    ("colours: visibility", r"SurfaceVisibility"),
    ("colours: projection, sampling, choice", r"color_candidates|exposures|PairSamples|choose_views|deviations|encoded_light|sample_color|colorize"),
    ("depth probe", r"PlaneWarp|PixelRays|WindowCorrelation|probe_depth|distinct_planes|undistort"),
    ("photographs: local normalisation", r"normalize_|add_similar|normalized"),
    ("photographs: pyramid", r"ImagePyramid|halve|prepared"),
    ("photographs: decoding", r"libjpeg|libopencv|read_photo|rgb_from_bgr|jpeg_is_complete"),
    ("tiles and mosaics: compression, files", r"libdeflate|libtiff|libgdal|libz\b|libz\.|libzstd|libproj|libsqlite|merge_children"),
    ("kernel: memory, files", r"\[kernel|\[k\]"),
]


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    report = subprocess.run(
        ["perf", "report", "-i", sys.argv[1], "--no-children", "-g", "none", "--sort", "dso,sym", "--stdio", "-t", "\t"],
        capture_output=True, text=True, check=True).stdout
    if "cpu-clock" not in report:
        sys.exit("stage_times: record with -e cpu-clock, whose counts are nanoseconds")
    seconds = float(re.search(r"Event count \(approx\.\): (\d+)", report).group(1)) * 1e-9
    shares: dict[str, float] = {}
    for line in report.splitlines():
        if line.startswith("#") or "\t" not in line:
            continue
        share, *where = (field.strip() for field in line.split("\t"))
        stage = next((name for name, pattern in STAGES if re.search(pattern, " ".join(where))), "everything else")
        shares[stage] = shares.get(stage, 0) + float(share.rstrip("%"))
    print("| stage | CPU s | share |\n|---|---|---|")
    for stage, share in sorted(shares.items(), key=lambda item: -item[1]):
        print(f"| {stage} | {share / 100 * seconds:.2f} | {share:.1f} % |")
    print(f"| all | {seconds:.1f} | |")


if __name__ == "__main__":
    main()
