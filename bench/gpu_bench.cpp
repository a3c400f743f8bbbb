// SPDX-License-Identifier: Apache-2.0
// Throughput of the gpu backend on the machine's device, in luminance samples a second (cells x planes x views x window
// levels), beside the device's ceiling measured in the same run: programs that do nothing but sample the same
// photographs at the same places, exactly as the sweep does (four pixels gathered, weighed in single precision), and
// through the hardware's filter. Times are those of the wall clock with the device finished. Run:
// build/release/bench/gpu_bench
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gpu/program.h"
#include "gpu/timer.h"
#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/smoothing.h"
#include "sweep/synthetic_views.h"

namespace {

using namespace skysweep;
using namespace skysweep::sweep;

constexpr int kCells = 256;

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

const test::SyntheticProblem& eight_views() {
  static const test::SyntheticProblem problem = [] {
    test::SyntheticProblem p = test::ring_of_views(8, test::small_camera(600, 640, 480), rolling);
    test::set_grid(p.problem, kCells, 0.05, 0.06, -2.5, 2.5);
    return p;
  }();
  return problem;
}

// One sample a thread and turn, 16 x 16 threads beside each other as cells are, a turn a plane: rows of pixels further
// on, like the sweep's. LINEAR: the hardware's filter.
constexpr const char* kSampling = R"(
layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) writeonly buffer Sums { float sums[]; };
layout(binding = 0) uniform sampler2DArray pictures;
uniform int turns, layers, across;
void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  vec2 size = vec2(textureSize(pictures, 0).xy);
  vec2 cell = 16 * vec2(group % across, group / across) + vec2(gl_LocalInvocationID.xy);
  float sum = 0;
  for (int turn = 0; turn < turns; ++turn) {
    for (int layer = 0; layer < layers; ++layer) {
      vec2 position = 20 + 1.1 * cell + vec2(0.37, 0.21) * turn;
#if LINEAR
      sum += textureLod(pictures, vec3((position + 0.5) / size, layer), 0).r;
#else
      vec2 whole = floor(position), weight = position - whole;
      vec4 four = textureGather(pictures, vec3((whole + 1) / size, layer));
      vec2 rows = mix(four.wx, four.zy, weight.x);
      sum += mix(rows.x, rows.y, weight.y);
#endif
    }
  }
  sums[group * 256 + int(gl_LocalInvocationIndex)] = sum;
}
)";

void set_rate(benchmark::State& state, double samples) {
  state.counters["samples/s"] =
      benchmark::Counter(samples * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void pure_sampling(benchmark::State& state, bool linear) {
  const auto device = gpu::Device::open();
  const auto& views = eight_views().problem.views;
  const LuminanceLevel& first = views[0].image->luminance(0);
  const int layers = static_cast<int>(views.size()), planes = eight_views().problem.all_planes().count();
  gpu::TextureArray pictures(*device, first.width + 2, first.height + 2, layers, 1,
                             linear ? gpu::Filter::linear : gpu::Filter::nearest);
  for (int layer = 0; layer < layers; ++layer) {
    const LuminanceLevel& level = views[layer].image->luminance(0);
    const Array2d<std::uint16_t> pixels = level.pixels_with_border();
    pictures.write(layer, 0, 0, 0, pixels.width(), pixels.height(), pixels.data(), pixels.width());
  }
  gpu::Program program(*device, "sampling", {{"LINEAR", linear ? "1" : "0"}}, kSampling);
  const int turns = planes * 4;  // as many as there are planes and window levels
  program.set("turns", turns);
  program.set("layers", layers);
  program.set("across", kCells / 16);
  constexpr int kGroups = kCells * kCells / 256;
  gpu::Buffer sums(*device, std::size_t{kCells} * kCells * sizeof(float));
  device->finish();
  for (auto _ : state) {
    program.run(kGroups, {&sums}, &pictures);
    device->finish();
  }
  if (!device->is_software()) {  // llvmpipe's clock does not see compute programs
    gpu::Timer timer(*device);
    program.run(kGroups, {&sums}, &pictures);
    state.counters["device ms"] = 1e3 * timer.stop_s();
  }
  std::vector<float> values(std::size_t{kCells} * kCells);
  sums.read(values.data(), sums.bytes());
  for (const float value : values)
    if (!(value > 0)) return state.SkipWithError("a sum of samples is nothing");
  set_rate(state, static_cast<double>(values.size()) * turns * layers);
}
BENCHMARK_CAPTURE(pure_sampling, exact, false)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pure_sampling, hardware_filter, true)->UseRealTime()->Unit(benchmark::kMillisecond);

double share_with_height(const SweepProblem& problem, const MatchResult& matches) {
  const Heights heights = heights_from_matches(problem, matches);
  double known = 0;
  for (const float z : heights.height_m) known += !std::isnan(z);
  return known / static_cast<double>(heights.height_m.size());
}

// Wall clock, uploads of the problem and the read-back included; photographs are on the device after the first.
template <typename Match>
void bench_matching(benchmark::State& state, const Match& match) {
  SerialExecutor serial;
  const SweepProblem& problem = eight_views().problem;
  MatchResult matches = match(problem, serial);
  for (auto _ : state) matches = match(problem, serial);
  if (share_with_height(problem, matches) < 0.9) state.SkipWithError("fewer than 90 % of the cells have a height");
  set_rate(state, sample_count(problem));
}

void cell_by_cell(benchmark::State& state, Backend backend) {
  bench_matching(state, [&](const SweepProblem& problem, Executor& executor) {
    return match_cell_by_cell(problem, backend, executor);
  });
}
BENCHMARK_CAPTURE(cell_by_cell, gpu, Backend::gpu)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cell_by_cell, one_cpu_core, Backend::cpu)->UseRealTime()->Unit(benchmark::kMillisecond);

void with_smoothing(benchmark::State& state, Backend backend) {
  bench_matching(
      state, [&](const SweepProblem& problem, Executor& executor) { return match_planes(problem, backend, executor); });
}
BENCHMARK_CAPTURE(with_smoothing, gpu, Backend::gpu)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(with_smoothing, one_cpu_core, Backend::cpu)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  try {
    const GpuDevice device = gpu_device();
    benchmark::AddCustomContext("device", device.name + (device.is_software ? " (software)" : ""));
  } catch (const Error& error) {
    std::printf("No GPU bench: %s\n", error.what());
    return 0;
  }
  listen_to_gpu_trouble([](const std::string& sentence) {
    std::printf("%s\n", sentence.c_str());
    std::exit(1);  // a figure of the cpu must not pass for the GPU's
  });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
