// SPDX-License-Identifier: Apache-2.0
// What surrounds the matching in a run, on one core: finding the ground of a new project, preparing photographs,
// counting views for the evidence, choosing colours; each beside what it would cost at the least, or the plain way.
// Each bench checks its result. Run: build/release/bench/run_parts_bench
#include <benchmark/benchmark.h>

#include <cmath>

#include "sweep/depth_probe.h"
#include "sweep/orthophoto.h"
#include "sweep/plane_warp.h"
#include "sweep/shown_planes.h"
#include "sweep/synthetic_views.h"
#include "sweep/view_costs.h"

namespace {

using namespace skysweep;
using namespace skysweep::sweep;

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

// Eight views with a little lens distortion, 256 x 256 cells.
const test::SyntheticProblem& eight_views() {
  static const test::SyntheticProblem problem = [] {
    camera::CameraModel model = test::small_camera(600, 640, 480);
    model.distortion = {-0.02, 0.004, 1e-4, -1e-4, 0};
    test::SyntheticProblem p = test::ring_of_views(8, model, rolling);
    test::set_grid(p.problem, 256, 0.05, 0.02, -5, 5);
    return p;
  }();
  return problem;
}

void set_rate(benchmark::State& state, const char* unit, double items) {
  state.counters[unit] =
      benchmark::Counter(items * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void depth_probe(benchmark::State& state) {
  const std::vector<View>& views = eight_views().problem.views;
  std::optional<DepthProbe> found;
  for (auto _ : state) found = probe_depth(views[0], {views.begin() + 1, views.begin() + 5});
  if (!found || std::abs(found->median_m - 30) > 2) state.SkipWithError("the ground is 30 m down");
}
BENCHMARK(depth_probe)->Unit(benchmark::kMillisecond);

constexpr int kWarpLevel = 2;
constexpr double kWarpDepth = 30;

double known_share(const Array2d<float>& values) {
  double known = 0;
  for (const float value : values) known += !std::isnan(value);
  return known / static_cast<double>(values.size());
}

void warp_by_turned_rays(benchmark::State& state) {
  const std::vector<View>& views = eight_views().problem.views;
  const PixelRays rays(views[0], kWarpLevel);
  PlaneWarp warp(rays, views[1]);
  Array2d<float> out(rays.width, rays.height);
  for (auto _ : state) warp.warp(kWarpDepth, out);
  if (known_share(out) < 0.3) state.SkipWithError("the views overlap");
  set_rate(state, "pixels/s", static_cast<double>(out.size()));
}
BENCHMARK(warp_by_turned_rays);

void warp_by_asking_the_cameras(benchmark::State& state) {
  const std::vector<View>& views = eight_views().problem.views;
  const double z = views[0].camera.pose().center.z - kWarpDepth, size = std::ldexp(1.0, kWarpLevel);
  const LuminanceLevel& level = views[0].image->luminance(kWarpLevel);
  Array2d<float> out(level.width, level.height);
  for (auto _ : state) {
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        const auto point = views[0].camera.at_height({(x + 0.5) * size, (y + 0.5) * size}, z);
        const auto pixel = point ? views[1].camera.project(*point) : std::nullopt;
        const bool shown = pixel && views[1].camera.shows(*pixel);
        out(x, y) = shown ? static_cast<float>(views[1].image->sample_luminance(*pixel, kWarpLevel)) : std::nanf("");
      }
    }
  }
  if (known_share(out) < 0.3) state.SkipWithError("the views overlap");
  set_rate(state, "pixels/s", static_cast<double>(out.size()));
}
BENCHMARK(warp_by_asking_the_cameras);

Array2d<Rgb8> photograph() {
  Array2d<Rgb8> image(1920, 1080);
  Random random(3);
  for (Rgb8& p : image)
    p = {static_cast<std::uint8_t>(random.below(256)), static_cast<std::uint8_t>(random.below(256)), 90};
  return image;
}

void photograph_copied(benchmark::State& state) {
  const Array2d<Rgb8> image = photograph();
  for (auto _ : state) {
    Array2d<Rgb8> copy = image;
    benchmark::DoNotOptimize(copy.data());
  }
  set_rate(state, "pixels/s", static_cast<double>(image.size()));
}
BENCHMARK(photograph_copied)->Unit(benchmark::kMillisecond);

void photograph_prepared(benchmark::State& state, int normalization_radius_px) {
  const Array2d<Rgb8> image = photograph();
  double mean = 0;
  for (auto _ : state) {
    const ImagePyramid pyramid(image, normalization_radius_px);
    mean = pyramid.sample_luminance({960, 540}, pyramid.levels() - 1);
  }
  if (!(mean > 100 && mean < 150)) state.SkipWithError("the whole photograph's mean is about 125");
  set_rate(state, "pixels/s", static_cast<double>(image.size()));
}
BENCHMARK_CAPTURE(photograph_prepared, as_photographed, 0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(photograph_prepared, normalised_within_2_px, 2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(photograph_prepared, normalised_within_5_px, 5)->Unit(benchmark::kMillisecond);

// Views counted at all planes of every 8th cell.
template <typename Count>
void count_views(benchmark::State& state, Count count_at) {
  const SweepProblem& problem = eight_views().problem;
  const PlaneRange planes = problem.all_planes();
  double shown = 0, cells = 0;
  for (auto _ : state) {
    shown = cells = 0;
    for (int row = 0; row < problem.grid.height; row += 8)
      for (int column = 0; column < problem.grid.width; column += 8, ++cells)
        shown += count_at(problem, problem.grid.cell_center(column, row), planes);
  }
  const double mean = shown / cells / planes.count();
  if (!(mean > 6 && mean < 8)) state.SkipWithError("between 6 and 8 views show a cell");
  set_rate(state, "cells/s", cells);
}

void views_counted_by_bisection(benchmark::State& state) {
  ShownPlanes shown(eight_views().problem);
  count_views(state, [&](const SweepProblem&, Vec2d cell, PlaneRange planes) {
    double sum = 0;
    shown.look_at(cell, planes);
    shown.for_each_run(planes, [&](PlaneRange run, int n) { sum += n * run.count(); });
    return sum;
  });
}
BENCHMARK(views_counted_by_bisection)->Unit(benchmark::kMillisecond);

void views_counted_plane_by_plane(benchmark::State& state) {
  count_views(state, [](const SweepProblem& problem, Vec2d cell, PlaneRange planes) {
    double sum = 0;
    for (int k = planes.first; k <= planes.last; ++k)
      sum += views_showing(problem, {cell.x, cell.y, k * problem.dz_m}).count;
    return sum;
  });
}
BENCHMARK(views_counted_plane_by_plane)->Unit(benchmark::kMillisecond);

void colours_chosen(benchmark::State& state) {
  const SweepProblem& problem = eight_views().problem;
  const Grid& grid = problem.grid;
  SweepResult result;
  result.height_m = Array2d<float>(grid.width, grid.height);
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const Vec2d cell = grid.cell_center(column, row);
      result.height_m(column, row) = static_cast<float>(rolling(cell.x, cell.y));
    }
  SerialExecutor serial;
  for (auto _ : state) colorize(problem, serial, result);
  const auto colored = std::count_if(result.color.begin(), result.color.end(), [](Rgba8 c) { return c.a == 255; });
  if (colored < static_cast<long>(result.color.size() * 99 / 100)) state.SkipWithError("every cell has a colour");
  set_rate(state, "cells/s", static_cast<double>(result.color.size()));
}
BENCHMARK(colours_chosen)->Unit(benchmark::kMillisecond);

// The least that choosing a colour takes: where do the views show the cell, and what?
void colours_only_sampled(benchmark::State& state) {
  const SweepProblem& problem = eight_views().problem;
  double sum = 0;
  for (auto _ : state) {
    sum = 0;
    for (int row = 0; row < problem.grid.height; ++row)
      for (int column = 0; column < problem.grid.width; ++column) {
        const Vec2d cell = problem.grid.cell_center(column, row);
        const ViewSamples samples = sample_views(problem, {cell.x, cell.y, rolling(cell.x, cell.y)});
        sum += samples.count;
      }
  }
  const double cells = static_cast<double>(problem.grid.width) * problem.grid.height;
  if (!(sum / cells > 6)) state.SkipWithError("more than 6 views show a cell");
  set_rate(state, "cells/s", cells);
}
BENCHMARK(colours_only_sampled)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
