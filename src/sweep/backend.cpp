// SPDX-License-Identifier: Apache-2.0
#include "sweep/backend.h"

#include "sweep/bands.h"
#include "sweep/best_planes.h"
#include "sweep/cpu/best_planes_cpu.h"
#include "sweep/cpu/match_cpu.h"
#include "sweep/cpu/patches_cpu.h"
#include "sweep/cpu/smoothing_cpu.h"
#include "sweep/gpu/engine.h"
#include "sweep/gpu/match_gpu.h"
#include "sweep/reference/match_reference.h"
#include "sweep/reference/smoothing_reference.h"
#include "sweep/smoothing.h"
#include "sweep/sub_plane.h"

namespace skysweep::sweep {

const char* to_string(Backend backend) {
  switch (backend) {
    case Backend::reference: return "reference";
    case Backend::cpu: return "cpu";
    case Backend::gpu: return "gpu";
  }
  return "unknown";
}

namespace {

// What the device cannot do is done by the other.
template <typename OnGpu, typename OnCpu>
auto gpu_or_cpu(const SweepOptions& options, OnGpu try_gpu, OnCpu take_cpu) {
  if (const auto reason = why_not_on_gpu(options)) {
    on_gpu::tell_gpu_listener("The cpu backend computes what the GPU could not. " + *reason + ".");
    return take_cpu();
  }
  try {
    return try_gpu();
  } catch (const skysweep::gpu::DeviceError& error) {
    on_gpu::tell_gpu_listener(std::string("The cpu backend computes what the GPU could not. ") + error.what());
  }
  return take_cpu();
}

CostVolume costs_on_cpu(const SweepProblem& problem, Executor& executor) {
  return problem.options.cost == MatchingCost::sad ? cpu::match_costs(problem, executor)
                                                   : cpu::match_patch_costs(problem, executor);
}

MatchResult cells_on_cpu(const SweepProblem& problem, Executor& executor) {
  return problem.options.cost == MatchingCost::sad ? cpu::match_cell_by_cell(problem, executor)
                                                   : cpu::match_patches_cell_by_cell(problem, executor);
}

MatchResult match_in_bands(const SweepProblem& problem, Backend backend, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  for (const Band& band : bands_within(problem)) {
    const SweepProblem part = part_of(problem, band);
    const CostVolume costs = match_costs(part, backend, executor);
    const CostVolume sums = smooth(part, costs, backend);
    MatchResult matches =
        backend == Backend::reference ? best_planes(costs, sums) : cpu::best_planes(costs, sums, executor);
    refine_fractions(part, costs, executor, matches);
    copy_core(matches, band, result);
  }
  return result;
}

}  // namespace

MatchResult match_planes(const SweepProblem& problem, Backend backend, Executor& executor) {
  if (problem.options.smoothing == Smoothing::none) return match_cell_by_cell(problem, backend, executor);
  if (backend != Backend::gpu) return match_in_bands(problem, backend, executor);
  return gpu_or_cpu(
      problem.options, [&] { return on_gpu::match_planes(problem); },
      [&] { return match_in_bands(problem, Backend::cpu, executor); });
}

CostVolume match_costs(const SweepProblem& problem, Backend backend, Executor& executor) {
  switch (backend) {
    case Backend::reference: return reference::match_costs(problem, executor);
    case Backend::cpu: break;
    case Backend::gpu:
      return gpu_or_cpu(
          problem.options, [&] { return on_gpu::match_costs(problem); },
          [&] { return costs_on_cpu(problem, executor); });
  }
  return costs_on_cpu(problem, executor);
}

MatchResult match_cell_by_cell(const SweepProblem& problem, Backend backend, Executor& executor) {
  switch (backend) {
    case Backend::reference: return reference::match_cell_by_cell(problem, executor);
    case Backend::cpu: break;
    case Backend::gpu:
      return gpu_or_cpu(
          problem.options, [&] { return on_gpu::match_cell_by_cell(problem); },
          [&] { return cells_on_cpu(problem, executor); });
  }
  return cells_on_cpu(problem, executor);
}

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs, Backend backend) {
  switch (backend) {
    case Backend::reference: return reference::smooth(problem, costs);
    case Backend::cpu: break;
    case Backend::gpu:
      return gpu_or_cpu(
          problem.options, [&] { return on_gpu::smooth(problem, costs); }, [&] { return cpu::smooth(problem, costs); });
  }
  return cpu::smooth(problem, costs);
}

std::optional<std::string> why_not_on_gpu(const SweepOptions& options) {
  if (options.cost == MatchingCost::sad) return std::nullopt;
  return "The gpu backend compares views by cost = \"sad\" only, not by patches (\"zncc\", \"census\")";
}

GpuDevice gpu_device() {
  skysweep::gpu::Device& device = on_gpu::engine()->device();
  return {device.name(), device.is_software()};
}

Backend default_backend() {
  if (!skysweep::gpu::Device::lists_real_gpu()) return Backend::cpu;
  try {
    return gpu_device().is_software ? Backend::cpu : Backend::gpu;
  } catch (const skysweep::gpu::DeviceError&) {
    return Backend::cpu;
  }
}

void listen_to_gpu_trouble(std::function<void(const std::string&)> listener) {
  on_gpu::set_gpu_listener(std::move(listener));
}

}  // namespace skysweep::sweep
