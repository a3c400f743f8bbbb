// SPDX-License-Identifier: Apache-2.0
#include "sweep/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sweep/expected_planes.h"
#include "sweep/guide_image.h"

namespace skysweep::sweep {
namespace {

// Finer planes kept above and below a height found: half a coarse plane, what the coarser pixels blur, and the
// neighbours that the fit between planes needs.
constexpr int kMarginPlanes = 3;
// Coarse cells around a block whose heights count for it, too.
constexpr int kReachCells = 1;
// How far the surface must rise above a line of sight to hide what is behind, and how near to a cell nothing does:
// heights scatter, and edges stand where smoothing put them.
constexpr double kOcclusionTolerancePlanes = 2;
constexpr int kSkippedCells = 1;
// Ranges so near to each other that skipping the planes between saves nothing.
constexpr int kBridgedPlanes = 3;

// The same question on cells twice as large; blocks take the planes of the blocks they cover.
SweepProblem doubled(const SweepProblem& fine) {
  SweepProblem coarse = fine;
  coarse.grid = {(fine.grid.width + 1) / 2, (fine.grid.height + 1) / 2, 2 * fine.grid.cell_m,
                 fine.grid.north_west_corner};
  coarse.dz_m = 2 * fine.dz_m;
  for (View& view : coarse.views) ++view.base_level;
  coarse.search_everywhere({});
  for (int by = 0; by < fine.block_planes.height(); ++by)
    for (int bx = 0; bx < fine.block_planes.width(); ++bx)
      for (const PlaneRange& range : fine.block_planes(bx, by).ranges())
        coarse.block_planes(bx / 2, by / 2).include(PlaneRange{range.first >> 1, (range.last >> 1) + 1});
  return coarse;
}

PlaneRange finer_planes_around(int k) { return {2 * k - kMarginPlanes, 2 * k + kMarginPlanes}; }

// Planes of the finer grid around what the coarse cells of a window found.
PlaneSet planes_near(const MatchResult& found, double rival_tolerance, int left, int top, int right, int bottom) {
  PlaneSet planes;
  const auto keep = [&planes](int k) {
    if (const PlaneRange around = finer_planes_around(k); !planes.contains(around)) planes.include(around);
  };
  for (int row = std::max(0, top); row < std::min(found.plane.height(), bottom); ++row) {
    for (int column = std::max(0, left); column < std::min(found.plane.width(), right); ++column) {
      if (!std::isfinite(found.cost(column, row))) continue;
      keep(found.plane(column, row));
      if (found.rival_excess(column, row) <= rival_tolerance) keep(found.rival_plane(column, row));
    }
  }
  planes.bridge(kBridgedPlanes);
  return planes;
}

void keep_planes_near(const MatchResult& found, SweepProblem& fine) {
  constexpr int kCoarseCells = kBlockCells / 2;
  for (int by = 0; by < fine.block_planes.height(); ++by) {
    for (int bx = 0; bx < fine.block_planes.width(); ++bx) {
      const int x = bx * kCoarseCells, y = by * kCoarseCells;
      PlaneSet planes = planes_near(found, fine.options.rival_tolerance, x - kReachCells, y - kReachCells,
                                    x + kCoarseCells + kReachCells, y + kCoarseCells + kReachCells);
      planes.clip(fine.block_planes(bx, by).hull());
      fine.block_planes(bx, by) = std::move(planes);
    }
  }
}

// Limits the views of `coarse` where `found` is not sure to those that see past the heights of which it is.
void look_past(const MatchResult& found, Executor& executor, SweepProblem& coarse) {
  const int width = coarse.grid.width, height = coarse.grid.height;
  Array2d<float> sure(width, height, std::numeric_limits<float>::quiet_NaN());
  Array2d<std::uint8_t> unsure(width, height, 0);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      if (!std::isfinite(found.cost(column, row))) continue;
      if (found.rival_excess(column, row) >= coarse.options.sure_excess)
        sure(column, row) = static_cast<float>(found.plane(column, row) * coarse.dz_m);
      else
        unsure(column, row) = 1;
    }
  }
  const HorizonQuestion question{sure, unsure, coarse.all_planes().first * coarse.dz_m,
                                 kOcclusionTolerancePlanes * coarse.dz_m, kSkippedCells};
  coarse.visibility = {std::make_shared<const Horizons>(coarse.grid, coarse.views, question, executor), 1, 0};
}

// What smoothing goes by: the slopes and edges of what was found on cells `times` as large.
void expect(const MatchResult& found, int times, Executor& executor, SweepProblem& problem) {
  if (problem.options.smoothing == Smoothing::none) return;
  if (problem.options.follow_slopes) problem.expected_plane = expected_planes(found, times, problem);
  if (problem.options.edge_contrast > 0) problem.guide = guide_image(problem, found, times, executor);
}

Array2d<float> spread(const Array2d<float>& coarse, int times, int width, int height) {
  Array2d<float> fine(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) fine(column, row) = coarse(column / times, row / times);
  return fine;
}

}  // namespace

NarrowedSearch narrow_search(const SweepProblem& problem, Backend backend, Executor& executor, double& samples) {
  SKY_CHECK_GT(problem.options.coarse_levels, 0);
  std::vector<SweepProblem> scales = {problem};
  for (int level = 0; level < problem.options.coarse_levels; ++level) scales.push_back(doubled(scales.back()));
  NarrowedSearch out;
  for (std::size_t scale = scales.size() - 1; scale > 0; --scale) {
    SweepProblem& coarse = scales[scale];
    MatchResult found = match_planes(coarse, backend, executor);
    samples += sample_count(coarse);
    for (int pass = 0; scale == 1 && pass < coarse.options.visibility_passes; ++pass) {
      look_past(found, executor, coarse);
      expect(found, 1, executor, coarse);
      found = match_planes(coarse, backend, executor);
      samples += sample_count(coarse);
    }
    if (scale + 1 == scales.size())
      out.mean_cost = spread(found.mean_cost, 1 << scale, problem.grid.width, problem.grid.height);
    keep_planes_near(found, scales[scale - 1]);
    scales[scale - 1].visibility = coarse.visibility;
    scales[scale - 1].visibility.times = 2;
    expect(found, 2, executor, scales[scale - 1]);
  }
  out.problem = std::move(scales.front());
  return out;
}

}  // namespace skysweep::sweep
