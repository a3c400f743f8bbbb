#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/build.sh [PRESET [TARGET...]]
# Configures and builds into build/PRESET (release unless told otherwise), all targets unless some are named.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake --preset "$preset" "${launcher[@]}"
if [[ $# -gt 1 ]]; then targets=(--target "${@:2}"); else targets=(); fi
cmake --build --preset "$preset" "${targets[@]}"
