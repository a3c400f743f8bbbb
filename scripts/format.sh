#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/format.sh [--check]
# Formats every C++ file as .clang-format says. --check changes nothing and fails where something would change; without
# clang-format 14 (other versions format differently) it checks nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

check=false
if [[ ${1:-} == --check ]]; then check=true; fi
formatter=$(command -v clang-format-14 || command -v clang-format || true)
if [[ -z $formatter ]] || ! "$formatter" --version | grep -q 'version 14\.'; then
  echo "format: clang-format 14 is not installed (apt-get install clang-format)"
  $check && exit 0
  exit 1
fi

sources() { find src tests bench \( -name '*.h' -o -name '*.cpp' \) -print0; }
if ! $check; then
  sources | xargs -0 "$formatter" -i
elif ! sources | xargs -0 "$formatter" --dry-run -Werror; then
  echo "format: scripts/format.sh mends this"
  exit 1
fi
