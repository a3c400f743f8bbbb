#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/demo.sh [--fresh]
# From nothing to a map: installs what is missing, builds, simulates a flight over a small town, reconstructs the town
# from its photographs and measures the result against the truth. A second call uses what is there; --fresh begins anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case "${*:-}" in
  "") ;;
  --fresh) rm -rf demo ;;
  *) echo "usage: scripts/demo.sh [--fresh]" >&2; exit 2 ;;
esac

step() {  # step NAME COMMAND...: runs the command and says how long it took
  local name=$1 begin=$SECONDS
  shift
  printf '\n== %s\n' "$name"
  "$@"
  printf '== %s: %d s\n' "$name" $((SECONDS - begin))
}

skysweep=build/release/skysweep
scene=config/scenes/demo_town.toml
gsd_m=0.05  # the photographs' ground sampling distance in that scene

simulate() {
  if [[ -d demo/flight && ! $scene -nt demo/flight ]]; then
    echo "demo/flight is there already"
    return
  fi
  # Simulated aside and renamed when whole: an interrupted simulation is not taken for a flight.
  rm -rf demo
  "$skysweep" simulate "$scene" -o demo/flight.part
  mv demo/flight.part demo/flight
}

evaluate() {
  "$skysweep" evaluate --dsm demo/map/dsm.tif --truth demo/flight/truth/dsm.tif \
    --mask demo/flight/truth/views.tif --mask-min 3 --gsd "$gsd_m" \
    --ortho demo/map/ortho.tif --truth-ortho demo/flight/truth/ortho.tif
}

step "Packages" scripts/setup.sh
step "Build" scripts/build.sh release skysweep
step "Simulated flight" simulate
step "Reconstruction" "$skysweep" run demo/flight/images --poses demo/flight/poses.csv -o demo/map --cell 0.1
step "Accuracy" evaluate

cat <<END

Done in $SECONDS s. What to open:
  demo/map/preview.png     the surface as a hillshade
  demo/map/dsm.tif         heights in metres     (QGIS, GDAL)
  demo/map/ortho.tif       true orthophoto
  demo/map/confidence.tif  sigma of each height in metres
  demo/flight/images       the photographs it was made from
END
