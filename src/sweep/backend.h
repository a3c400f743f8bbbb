// SPDX-License-Identifier: Apache-2.0
// The interchangeable engines of the sweep. All give the same answer within the bounds of tests/contract.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

enum class Backend {
  reference,  // scalar, double precision, written to be read: the oracle of the others
  cpu,        // SIMD, the best instruction set the machine has, chosen at run time
  gpu,        // OpenGL compute programs; what the device cannot do (lost, full) is computed by cpu, and said
};

const char* to_string(Backend backend);

// The search over planes, as options.smoothing says. The result does not depend on how `executor` runs its parts.
MatchResult match_planes(const SweepProblem& problem, Backend backend, Executor& executor);

// Its stages: the costs of all planes; or, without smoothing, the best plane of each cell by itself, with no volume
// kept.
CostVolume match_costs(const SweepProblem& problem, Backend backend, Executor& executor);
MatchResult match_cell_by_cell(const SweepProblem& problem, Backend backend, Executor& executor);

// Why the gpu backend cannot serve these options, a sentence without its full stop; nothing if it can.
std::optional<std::string> why_not_on_gpu(const SweepOptions& options);

// The device of the gpu backend, opened on the first call. Throws Error(failed) that says why there is none.
struct GpuDevice {
  std::string name;
  bool is_software = false;  // a rasteriser on the CPU (llvmpipe): correct, and slower than the cpu backend
};
GpuDevice gpu_device();
// What suits this machine: gpu if it has a real one, else cpu.
Backend default_backend();
// Called with a sentence, from any thread, whenever a tile had to be computed by cpu instead; null: nobody listens.
void listen_to_gpu_trouble(std::function<void(const std::string&)> listener);

// The machine's ceiling for benches: takes `samples` bilinear samples along lines through the finest level of `image`
// with the cpu backend's own instructions and nothing else, and returns their sum in stored units.
double bilinear_sampling_ceiling(const ImagePyramid& image, long long samples);

// Instruction sets of the cpu backend that this machine has, best first; and the one in use.
std::vector<std::string> cpu_instruction_sets();
std::string cpu_instruction_set_in_use();
// Uses exactly this one from now on, for the whole process (tests, and projects made on another machine). Throws
// Error(usage) if the machine lacks it.
void use_cpu_instruction_set(const std::string& name);

}  // namespace skysweep::sweep
