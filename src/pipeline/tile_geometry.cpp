// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/luminance_gains.h"

namespace skysweep::pipeline {

using sweep::HeightRange;

TileGeometry::TileGeometry(tiles::TileKey key, const std::vector<const index::ImageRecord*>& candidates,
                           const ProjectSettings& settings)
    : settings_(settings) {
  const Vec2d corner = settings.lattice.south_west_corner(key);
  for (const index::ImageRecord* image : candidates)
    candidates_.push_back(
        {image->name, camera::Camera(image->model, image->pose).relative_to({corner.x, corner.y, 0})});
}

sweep::SweepProblem TileGeometry::empty_problem() const {
  const TileOptions& options = settings_.configuration.tiles;
  const double cell = settings_.lattice.cell_m;
  const int width = options.cells + 2 * options.collar_cells;
  sweep::SweepProblem problem;
  problem.grid = {width, width, cell, {-options.collar_cells * cell, (options.cells + options.collar_cells) * cell}};
  problem.collar_cells = options.collar_cells;
  problem.dz_m = settings_.lattice.dz_m;
  problem.options = settings_.configuration.sweep;
  problem.search_everywhere({});
  return problem;
}

HeightRange TileGeometry::guessed_heights() const {
  if (settings_.search.heights) return *settings_.search.heights;
  if (candidates_.empty()) return {};
  std::vector<double> heights;
  for (const index::ViewCandidate& c : candidates_) heights.push_back(c.camera.pose().center.z);
  std::sort(heights.begin(), heights.end());
  const double ground = heights[heights.size() / 2] - settings_.search.ground_depth_m;
  return {ground, ground};
}

bool TileGeometry::guess_is_compared_on() const { return sweep::compares_luminance(settings_.configuration.sweep); }

HeightRange TileGeometry::searched_heights() const {
  if (settings_.search.heights) return *settings_.search.heights;
  HeightRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const index::ViewCandidate& c : candidates_) {
    const double z = c.camera.pose().center.z;
    range.z_low = std::min(range.z_low, z - settings_.search.farthest_depth_m);
    range.z_high = std::max(range.z_high, z - settings_.search.nearest_depth_m);
  }
  return range;
}

index::ViewSelection TileGeometry::select(const HeightRange& heights) const {
  const double size = settings_.lattice.tile_cells * settings_.lattice.cell_m;
  return index::select_views(candidates_, {{0, 0}, {size, size}}, heights.z_low, heights.z_high,
                             settings_.configuration.views);
}

std::vector<std::string> TileGeometry::names(const index::ViewSelection& selection) const {
  std::vector<std::string> names;
  for (const int i : selection.chosen) names.push_back(candidates_[i].name);
  return names;
}

std::vector<sweep::View> TileGeometry::views(const index::ViewSelection& selection,
                                             const std::vector<std::shared_ptr<const sweep::ImagePyramid>>& images,
                                             const HeightRange& heights) const {
  std::vector<sweep::View> views;
  for (std::size_t k = 0; k < selection.chosen.size(); ++k) {
    const camera::Camera& camera = candidates_[selection.chosen[k]].camera;
    views.push_back({images[k].get(), camera, base_level(camera, heights)});
  }
  return views;
}

std::vector<int> TileGeometry::base_levels(const index::ViewSelection& selection, const HeightRange& heights) const {
  std::vector<int> levels;
  for (const int i : selection.chosen) levels.push_back(base_level(candidates_[i].camera, heights));
  return levels;
}

// The mipmap level whose pixels are between 0.35 and 0.7 of a cell: never coarser than a cell, never so fine that most
// pixels fall between the cells.
int TileGeometry::base_level(const camera::Camera& camera, const HeightRange& heights) const {
  const double depth = camera.pose().center.z - 0.5 * (heights.z_low + heights.z_high);
  if (depth <= 0) return 0;
  const double pixels_per_cell = settings_.lattice.cell_m / camera.gsd(depth);
  return std::max(0, static_cast<int>(std::floor(std::log2(pixels_per_cell) - 0.5)));
}

Box2d tile_with_collar(tiles::TileKey key, const ProjectSettings& settings) {
  Box2d box = settings.lattice.extent(key);
  const double collar = settings.configuration.tiles.collar_cells * settings.lattice.cell_m;
  return {{box.min.x - collar, box.min.y - collar}, {box.max.x + collar, box.max.y + collar}};
}

}  // namespace skysweep::pipeline
