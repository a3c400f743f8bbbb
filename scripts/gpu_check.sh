#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: scripts/gpu_check.sh [--build-only]
# Checks the GPU backend on a bare machine: builds core, camera, gpu and sweep from the standard library, libepoxy and
# Highway alone (with GoogleTest and Google Benchmark), says which device there is, then runs the tests of the GPU layer
# and of the backends against the reference, and the bench beside the device's own sampling rate. Needs the packages
# build-essential cmake ninja-build pkg-config libepoxy-dev libhwy-dev libgtest-dev libbenchmark-dev.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh sweep-only gpu_test no_gpu_test sweep_test contract_test gpu_bench
echo "gpu_check: built in $SECONDS s"
if [[ ${1:-} == --build-only ]]; then exit 0; fi
build=build/sweep-only
"$build/tests/gpu/gpu_test"
"$build/tests/gpu/no_gpu_test"
"$build/tests/sweep/sweep_test" --gtest_filter='*Gpu*'
"$build/bench/gpu_bench"
"$build/tests/contract/contract_test"
