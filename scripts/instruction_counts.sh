#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/instruction_counts.sh
# Proves that a scene without effects does not pay for them: builds the program with and without effects, simulates the
# same small town with both under callgrind and compares the instructions executed inside simulate(). Ends with 1 if they
# differ by more than 0.5 %, or if the two flights are not the same, byte for byte. Takes a minute after the builds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

command -v valgrind >/dev/null || { echo "valgrind is not installed: apt-get install valgrind" >&2; exit 1; }
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/town.toml" <<'END'
seed = 3
area_m = [8, 6]

[town]
block_m = 8
street_m = 5
min_height_m = 2
max_height_m = 4

[camera]
width_px = 200
height_px = 150
focal_px = 195

[flight]
beyond_area_m = -2.5
END

count() {  # count ON|OFF: builds, simulates, prints the number of instructions
  local build=build/effects_${1,,} log=$folder/$1.log
  {
    cmake --preset release "${launcher[@]}" -B "$build" -DSKYSWEEP_EFFECTS="$1" -DSKYSWEEP_TESTS=OFF -DSKYSWEEP_BENCH=OFF
    cmake --build "$build" --target skysweep
    # Only what simulate() executes: starting the program takes as much again and depends on the libraries installed.
    valgrind --tool=callgrind --toggle-collect='skysweep::scene::simulate*' --callgrind-out-file=/dev/null \
      "$build/skysweep" simulate "$folder/town.toml" -o "$folder/$1" --threads 1
  } >"$log" 2>&1 || { tail -20 "$log" >&2; exit 1; }
  awk '/Collected :/ {print $NF}' "$log"
}

with=$(count ON)
without=$(count OFF)
diff -r "$folder/ON" "$folder/OFF"
awk -v with="$with" -v without="$without" 'BEGIN {
  if (without < 1e6) { print "too few instructions were counted: " without; exit 1 }
  percent = 100 * (with / without - 1)
  printf "with effects     %14d instructions\nwithout effects  %14d instructions\ndifference       %+14.4f %%\n", with, without, percent
  exit percent > 0.5 || percent < -0.5
}'
