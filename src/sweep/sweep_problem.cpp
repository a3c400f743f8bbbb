// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sweep/patch_costs.h"
#include "sweep/similar_normalization.h"

namespace skysweep::sweep {

std::optional<std::string> SweepOptions::problem() const {
  if (window_level_min < 0 || window_level_max < window_level_min || window_level_max > 8)
    return "window levels must satisfy 0 <= window_level_min <= window_level_max <= 8";
  if (patch_radius_cells < 1 || patch_radius_cells > 2) return "patch_radius_cells must be 1 or 2";
  if (cost != MatchingCost::sad && patch_reach(*this) > kMostPatchReach)
    return "patch_radius_cells * 2^window_level_max must not exceed " + std::to_string(kMostPatchReach) +
           " with cost = \"zncc\" or \"census\"";
  if (coarse_levels < 0 || coarse_levels > 6) return "coarse_levels must lie between 0 (search everywhere) and 6";
  if (!(rival_tolerance >= 0 && rival_tolerance <= 60)) return "rival_tolerance must lie between 0 and 60 grey levels";
  if (visibility_passes < 0 || visibility_passes > 8) return "visibility_passes must lie between 0 and 8";
  if (!(edge_contrast >= 0 && edge_contrast <= 255))
    return "edge_contrast must lie between 0 (off) and 255 grey levels";
  if (!(sure_excess >= 0)) return "sure_excess must be 0 or more (grey levels)";
  if (!(hidden_cost >= 0 && hidden_cost <= 60)) return "hidden_cost must lie between 0 and 60 grey levels";
  if (normalization_radius_px < 0 || normalization_radius_px > 100)
    return "normalization_radius_px must lie between 0 (off) and 100";
  if (normalization_tolerance < 0 || normalization_tolerance > 255)
    return "normalization_tolerance must lie between 0 (off) and 255 grey levels";
  if (normalization_tolerance > 0 && normalization_radius_px > kLargestSimilarRadius)
    return "a normalization_radius_px of more than " + std::to_string(kLargestSimilarRadius) +
           " needs normalization_tolerance = 0: all pixels in the window count then";
  if (!(consensus_share > 0 && consensus_share <= 1)) return "consensus_share must lie above 0 and not above 1";
  if (!(small_step_penalty >= 0 && large_step_penalty >= small_step_penalty && large_step_penalty <= 60))
    return "penalties must satisfy 0 <= small_step_penalty <= large_step_penalty <= 60 grey levels";
  if (refinement_radius_cells < 0 || refinement_radius_cells > 16)
    return "refinement_radius_cells must lie between 0 (off) and 16";
  if (volume_limit_mib < 1 || volume_limit_mib > 65536) return "volume_limit_mib must lie between 1 and 65536";
  if (min_views < 2 || min_views > kMaxViews) return "min_views must lie between 2 and " + std::to_string(kMaxViews);
  if (!(few_views_penalty >= 0 && few_views_penalty <= 100)) return "few_views_penalty must lie between 0 and 100";
  if (!(max_cost > 0)) return "max_cost must be positive (grey levels)";
  if (!(max_cost_to_mean > 0 && max_cost_to_mean <= 1)) return "max_cost_to_mean must lie above 0 and not above 1";
  if (speckle_cells < 0 || speckle_cells > 65536) return "speckle_cells must lie between 0 (off) and 65536";
  if (edge_passes < 0 || edge_passes > 8) return "edge_passes must lie between 0 (off) and 8";
  if (edge_reach_cells < 1 || edge_reach_cells > 16) return "edge_reach_cells must lie between 1 and 16";
  if (!(edge_penalty >= 0 && edge_penalty <= 255)) return "edge_penalty must lie between 0 and 255";
  if (!(edge_hidden_cost >= 0 && edge_hidden_cost <= 255)) return "edge_hidden_cost must lie between 0 and 255";
  if (close_gap_cells < 0 || close_gap_cells > 65536) return "close_gap_cells must lie between 0 (off) and 65536";
  if (!(seam_cost >= 0 && seam_cost <= 60)) return "seam_cost must lie between 0 (off) and 60 grey levels";
  if (!(plane_step_px > 0.01 && plane_step_px <= 4)) return "plane_step_px must lie between 0.01 and 4";
  return std::nullopt;
}

void SweepProblem::search_everywhere(PlaneRange planes) {
  block_planes = Array2d<PlaneSet>(blocks_across(grid.width), blocks_across(grid.height), planes);
}

PlaneRange SweepProblem::all_planes() const {
  PlaneRange all;
  for (const PlaneSet& planes : block_planes) all.include(planes.hull());
  return all;
}

SweepProblem::Rise SweepProblem::expected_rise(int from_column, int from_row, int to_column, int to_row,
                                               int apart) const {
  if (expected_plane.empty()) return {};
  const float from = expected_plane(from_column, from_row), to = expected_plane(to_column, to_row);
  if (std::isnan(from) || std::isnan(to)) return {};
  const int rise = static_cast<int>(std::lround(to)) - static_cast<int>(std::lround(from));
  if (std::abs(rise) > kSteepestExpectedRise * apart) return {};
  return {rise, to - from - static_cast<float>(rise)};
}

void SweepProblem::check() const {
  SKY_CHECK(grid.width > 0 && grid.height > 0 && grid.cell_m > 0 && dz_m > 0);
  SKY_CHECK(collar_cells >= 0 && 2 * collar_cells < std::min(grid.width, grid.height));
  SKY_CHECK_LE(views.size(), static_cast<std::size_t>(kMaxViews));
  SKY_CHECK_EQ(block_planes.width(), blocks_across(grid.width));
  SKY_CHECK_EQ(block_planes.height(), blocks_across(grid.height));
  SKY_CHECK(!options.problem());
  for (const View& view : views) {
    SKY_CHECK(view.image != nullptr);
    SKY_CHECK_EQ(view.image->width(), view.camera.model().width_px);
    SKY_CHECK_EQ(view.image->height(), view.camera.model().height_px);
    SKY_CHECK_GE(view.base_level, 0);
  }
}

double sample_count(const SweepProblem& problem) {
  double planes = 0;
  for (int by = 0; by < problem.block_planes.height(); ++by) {
    for (int bx = 0; bx < problem.block_planes.width(); ++bx) {
      const int width = std::min(kBlockCells, problem.grid.width - bx * kBlockCells);
      const int height = std::min(kBlockCells, problem.grid.height - by * kBlockCells);
      planes += static_cast<double>(width) * height * problem.block_planes(bx, by).count();
    }
  }
  const int levels = problem.options.window_level_max - problem.options.window_level_min + 1;
  return planes * problem.views.size() * levels;
}

}  // namespace skysweep::sweep
