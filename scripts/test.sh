#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/test.sh [PRESET] [CTEST ARGUMENT...]
# Everything a change has to pass: packages, build, layers, format, tests. Presets: release (default), dev, asan, tsan.
# For instance: scripts/test.sh asan -R Settings
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=release
if [[ $# -gt 0 && $1 != -* ]]; then
  preset=$1
  shift
fi
scripts/setup.sh
scripts/build.sh "$preset"
scripts/check_layers.py
scripts/format.sh --check
exec ctest --test-dir "build/$preset" --parallel "$(nproc)" --output-on-failure "$@"
