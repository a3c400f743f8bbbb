// SPDX-License-Identifier: Apache-2.0
#include "sweep/height_range.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sweep/heights.h"
#include "sweep/photometric_evidence.h"
#include "sweep/small_patches.h"

namespace skysweep::sweep {
namespace {

constexpr double kMaxCostToMean = 0.6;  // of a coarse cell that stands out
// A cost can stand out only from a mean over planes most of which are wrong: a narrow range is compared with planes
// outside it, too, and what is found there is forgotten.
constexpr int kFewestCoarsePlanes = 16;
// Neighbouring coarse cells belong together when they differ by at most so many coarse planes, and to a surface when so
// many belong together: false matches come in smaller patches.
constexpr double kConnectedPlanes = 2;
constexpr int kSmallestSurfaceCells = 24;
// Around the range found, in coarse planes: what the coarse sweep may have missed by its own resolution; above, also
// things too small for it that stand on what it found.
constexpr double kMarginCoarsePlanes = 2, kMarginAboveCoarsePlanes = 6;
// Ranges are found for areas of so many coarse cells across.
constexpr int kAreaCoarseCells = 8;
// An area is searched where the coarse surface lies up to this many coarse cells outside it, too: surfaces near a step
// reach over its border.
constexpr int kNeighborhoodCoarseCells = 16;
// An area of which the coarse sweep knows less than this share may hold a surface that it missed (a small roof whose
// texture is gone at that scale, with false matches in between): all heights of the tile are searched there, if they
// are at most so many planes: more cost minutes on real photographs of woods and gained nothing.
constexpr double kLeastKnownShare = 0.75;
constexpr int kMostPlanesSearchedBlindly = 400;

// At least kFewestCoarsePlanes of them around the same middle.
PlaneRange comparable_planes(PlaneRange planes) {
  const int missing = std::max(0, kFewestCoarsePlanes - planes.count());
  return {planes.first - missing / 2, planes.last + (missing + 1) / 2};
}

void forget_outside(Array2d<float>& height, double z_low, double z_high) {
  for (float& z : height)
    if (!(z >= z_low && z <= z_high)) z = std::numeric_limits<float>::quiet_NaN();
}

SweepProblem coarse_problem(const SweepProblem& fine, double z_low, double z_high) {
  SweepProblem coarse;
  const auto cells = [](int n) { return (n + kCoarseCells - 1) / kCoarseCells; };
  coarse.grid = {cells(fine.grid.width), cells(fine.grid.height), fine.grid.cell_m * kCoarseCells,
                 fine.grid.north_west_corner};
  coarse.dz_m = fine.dz_m * kCoarseCells;
  coarse.views = fine.views;
  for (View& view : coarse.views) view.base_level += std::countr_zero(static_cast<unsigned>(kCoarseCells));
  coarse.options = fine.options;
  coarse.options.window_level_min = 0;
  coarse.options.window_level_max = fine.options.cost == MatchingCost::sad ? 2 : 0;  // patches are wide as they are
  coarse.options.refinement_radius_cells = 0;                                        // ranges need no better heights
  coarse.options.max_cost_to_mean = kMaxCostToMean;
  coarse.search_everywhere(comparable_planes(planes_between(z_low, z_high, coarse.dz_m, 1)));
  return coarse;
}

// Range of the known heights in a window of coarse cells; nothing if there are none.
std::optional<HeightRange> range_within(const Array2d<float>& height, int x0, int y0, int x1, int y1) {
  std::optional<HeightRange> range;
  for (int y = std::max(0, y0); y < std::min(height.height(), y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(height.width(), x1); ++x) {
      const double z = height(x, y);
      if (std::isnan(z)) continue;
      if (!range) range = HeightRange{z, z};
      range->z_low = std::min(range->z_low, z);
      range->z_high = std::max(range->z_high, z);
    }
  }
  return range;
}

double known_share(const Array2d<float>& height, int x0, int y0, int x1, int y1) {
  int known = 0, all = 0;
  for (int y = y0; y < std::min(height.height(), y1); ++y) {
    for (int x = x0; x < std::min(height.width(), x1); ++x) {
      known += !std::isnan(height(x, y));
      ++all;
    }
  }
  return all > 0 ? static_cast<double>(known) / all : 0;
}

}  // namespace

Array2d<float> coarse_surface(const SweepProblem& problem, double z_low, double z_high, Backend backend,
                              Executor& executor) {
  const SweepProblem coarse = coarse_problem(problem, z_low, z_high);
  const MatchResult matches = match_planes(coarse, backend, executor);
  Heights found = heights_from_matches(coarse, matches);
  drop_heights_without_evidence(coarse, matches, executor, found);
  forget_outside(found.height_m, z_low - coarse.dz_m, z_high + coarse.dz_m);
  return without_small_patches(found.height_m, kConnectedPlanes * coarse.dz_m, kSmallestSurfaceCells);
}

std::optional<HeightRange> search_near(const Array2d<float>& surface, SweepProblem& problem) {
  const std::optional<HeightRange> whole = range_within(surface, 0, 0, surface.width(), surface.height());
  problem.search_everywhere({});
  if (!whole) return std::nullopt;

  const double coarse_plane_m = kCoarseCells * problem.dz_m, below_m = kMarginCoarsePlanes * coarse_plane_m,
               above_m = kMarginAboveCoarsePlanes * coarse_plane_m;
  const int all_planes = planes_between(whole->z_low - below_m, whole->z_high + above_m, problem.dz_m, 1).count();
  const double least_known = all_planes <= kMostPlanesSearchedBlindly ? kLeastKnownShare : 0;
  constexpr int kBlocksPerArea = kAreaCoarseCells * kCoarseCells / kBlockCells, reach = kNeighborhoodCoarseCells;
  for (int by = 0; by < problem.block_planes.height(); ++by) {
    for (int bx = 0; bx < problem.block_planes.width(); ++bx) {
      const int x = bx / kBlocksPerArea * kAreaCoarseCells, y = by / kBlocksPerArea * kAreaCoarseCells;
      const int right = x + kAreaCoarseCells, bottom = y + kAreaCoarseCells;
      HeightRange range = *whole;
      if (known_share(surface, x, y, right, bottom) >= least_known)
        range = range_within(surface, x - reach, y - reach, right + reach, bottom + reach).value_or(*whole);
      problem.block_planes(bx, by) = planes_between(range.z_low - below_m, range.z_high + above_m, problem.dz_m, 1);
    }
  }
  return whole;
}

}  // namespace skysweep::sweep
