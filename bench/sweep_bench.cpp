// SPDX-License-Identifier: Apache-2.0
// Throughput of the plane sweep on one core, in luminance samples a second (cells x planes x views x window levels),
// beside the machine's own ceiling measured in the same run: a loop that does nothing but bilinear samples of the same
// images. Each bench checks its result. Run: build/release/bench/sweep_bench
#include <benchmark/benchmark.h>

#include <cmath>

#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/plane_sweep.h"
#include "sweep/smoothing.h"
#include "sweep/synthetic_views.h"

namespace {

using namespace skysweep;
using namespace skysweep::sweep;

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

const test::SyntheticProblem& eight_views() {
  static const test::SyntheticProblem problem = [] {
    test::SyntheticProblem p = test::ring_of_views(8, test::small_camera(600, 640, 480), rolling);
    test::set_grid(p.problem, 256, 0.05, 0.06, -2.5, 2.5);
    return p;
  }();
  return problem;
}

double share_with_height(const SweepProblem& problem, const MatchResult& matches) {
  const Heights heights = heights_from_matches(problem, matches);
  double known = 0;
  for (const float z : heights.height_m) known += !std::isnan(z);
  return known / static_cast<double>(heights.height_m.size());
}

void set_rate(benchmark::State& state, double samples) {
  state.counters["samples/s"] =
      benchmark::Counter(samples * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

// The ceiling: bilinear samples along straight lines through one image, nothing else.
void pure_bilinear_sampling(benchmark::State& state) {
  const ImagePyramid& image = *eight_views().problem.views[0].image;
  constexpr std::int64_t kSamples = 1 << 22;
  double sum = 0;
  for (auto _ : state) sum += bilinear_sampling_ceiling(image, kSamples);
  if (!(sum > 0)) state.SkipWithError("the samples sum up to nothing");
  set_rate(state, kSamples);
}
BENCHMARK(pure_bilinear_sampling)->Unit(benchmark::kMillisecond);

void plane_search(benchmark::State& state, Aggregation aggregation, Backend backend, int cells) {
  SweepProblem problem = eight_views().problem;
  test::set_grid(problem, cells, 0.05, 0.06, -2.5, 2.5);
  problem.options.aggregation = aggregation;
  SerialExecutor serial;
  MatchResult matches;
  for (auto _ : state) matches = match_cell_by_cell(problem, backend, serial);
  if (share_with_height(problem, matches) < 0.9) state.SkipWithError("fewer than 90 % of the cells have a height");
  set_rate(state, sample_count(problem));
}
BENCHMARK_CAPTURE(plane_search, all_views, Aggregation::all_views, Backend::cpu, 256)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane_search, better_half, Aggregation::better_half, Backend::cpu, 256)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane_search, consensus, Aggregation::consensus, Backend::cpu, 256)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plane_search, reference, Aggregation::consensus, Backend::reference, 24)
    ->Unit(benchmark::kMillisecond);

void semi_global_smoothing(benchmark::State& state) {
  const SweepProblem& problem = eight_views().problem;
  SerialExecutor serial;
  const CostVolume costs = match_costs(problem, Backend::cpu, serial);
  for (auto _ : state) benchmark::DoNotOptimize(smooth(problem, costs, Backend::cpu));
  const double cells = static_cast<double>(problem.grid.width) * problem.grid.height * problem.all_planes().count();
  state.counters["path updates/s"] = benchmark::Counter(
      kSmoothingPaths * cells * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(semi_global_smoothing)->Unit(benchmark::kMillisecond);

// A tile of 512 x 512 cells, 8 views, 201 planes, of a gentle saddle.
const test::SyntheticProblem& whole_tile() {
  static const test::SyntheticProblem problem = [] {
    test::SyntheticProblem p = test::ring_of_views(8, test::small_camera(1200, 1280, 960),
                                                   [](double x, double y) { return 0.03 * (x * x - y * y); });
    test::set_grid(p.problem, 512, 0.025, 0.03, -3, 3);
    return p;
  }();
  return problem;
}

double share_right(const SweepProblem& problem, const MatchResult& matches, double tolerance_m) {
  const Heights heights = heights_from_matches(problem, matches);
  double right = 0;
  for (int row = 0; row < problem.grid.height; ++row) {
    for (int column = 0; column < problem.grid.width; ++column) {
      const Vec2d p = problem.grid.cell_center(column, row);
      right += std::abs(heights.height_m(column, row) - 0.03 * (p.x * p.x - p.y * p.y)) < tolerance_m;
    }
  }
  return right / static_cast<double>(problem.grid.width * problem.grid.height);
}

// The classic sweep: sums of absolute differences over windows of 1x1 to 8x8, all planes, no smoothing.
void tile_exhaustive_sad(benchmark::State& state) {
  SweepProblem problem = whole_tile().problem;
  problem.options.window_level_max = 3;
  problem.options.aggregation = Aggregation::all_views;
  problem.options.smoothing = Smoothing::none;
  SerialExecutor serial;
  MatchResult matches;
  for (auto _ : state) matches = match_cell_by_cell(problem, Backend::cpu, serial);
  if (share_right(problem, matches, 0.1) < 0.9) state.SkipWithError("fewer than 90 % of the heights are right");
  set_rate(state, sample_count(problem));
}
BENCHMARK(tile_exhaustive_sad)->Unit(benchmark::kMillisecond);

// The default costs and smoothing, searched everywhere (0) and from coarse to fine.
void tile_search(benchmark::State& state) {
  SweepProblem problem = whole_tile().problem;
  problem.options.coarse_levels = static_cast<int>(state.range(0));
  SerialExecutor serial;
  Search found;
  for (auto _ : state) found = search(problem, Backend::cpu, serial);
  const double right = share_right(problem, found.matches, 0.1);
  if (right < 0.98) state.SkipWithError("fewer than 98 % of the heights are right");
  state.counters["right"] = right;
  set_rate(state, found.samples);
}
BENCHMARK(tile_search)->Arg(0)->Arg(SweepOptions{}.coarse_levels)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
