// SPDX-License-Identifier: Apache-2.0
#include "index/selection/sightings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skysweep::index {
namespace {

std::array<Vec2d, kPoints> sample_points(const Box2d& tile) {
  std::array<Vec2d, kPoints> points;
  for (int i = 0; i < kPoints; ++i) {
    const double s = static_cast<double>(i % kPointsPerSide) / (kPointsPerSide - 1);
    const double t = static_cast<double>(i / kPointsPerSide) / (kPointsPerSide - 1);
    points[i] = {tile.min.x + s * tile.width(), tile.min.y + t * tile.height()};
  }
  return points;
}

// The quality is left without its GSD part, which depends on the other photographs.
TileView look_at_tile(const camera::Camera& camera, const std::array<Vec2d, kPoints>& points, double z_low,
                      double z_high, double max_off_nadir_deg) {
  const double middle_z = 0.5 * (z_low + z_high);
  TileView view;
  int shown = 0;
  view.smallest_off_nadir_deg = 180;
  for (int i = 0; i < kPoints; ++i) {
    Sighting& sighting = view.at[i];
    for (const double z : {z_low, middle_z, z_high}) {
      const auto pixel = camera.project({points[i].x, points[i].y, z});
      sighting.heights += pixel && camera.shows(*pixel);
    }
    if (sighting.heights == 0) continue;
    const Vec3d point{points[i].x, points[i].y, middle_z};
    shown += sighting.heights;
    sighting.ray = normalized(camera.pose().center - point);
    const double angle_deg = std::acos(std::clamp(sighting.ray.z, -1.0, 1.0)) * 180 / std::numbers::pi;
    view.smallest_off_nadir_deg = std::min(view.smallest_off_nadir_deg, angle_deg);
    const double steepness = angle_deg / max_off_nadir_deg;
    if (steepness < 1 && camera.depth(point) > 0)
      sighting.quality = 1 - steepness * steepness;
    else
      sighting.heights = 0;
  }
  view.coverage = static_cast<double>(shown) / (kPoints * kHeights);
  return view;
}

// Of two photographs that show the point alike, the one with half the GSD is worth twice as much.
void weigh_by_gsd(std::vector<TileView>& views, const std::vector<const camera::Camera*>& cameras,
                  const std::array<Vec2d, kPoints>& points, double middle_z) {
  std::vector<double> gsd(views.size());
  for (int i = 0; i < kPoints; ++i) {
    double finest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < views.size(); ++v) {
      if (views[v].at[i].heights == 0) continue;
      gsd[v] = cameras[v]->gsd(cameras[v]->depth({points[i].x, points[i].y, middle_z}));
      finest = std::min(finest, gsd[v]);
    }
    for (std::size_t v = 0; v < views.size(); ++v)
      if (views[v].at[i].heights > 0) views[v].at[i].quality *= finest / gsd[v];
  }
}

}  // namespace

std::vector<TileView> tile_views(const std::vector<const camera::Camera*>& cameras, const Box2d& tile, double z_low,
                                 double z_high, double max_off_nadir_deg) {
  const std::array<Vec2d, kPoints> points = sample_points(tile);
  std::vector<TileView> views;
  for (const camera::Camera* camera : cameras)
    views.push_back(look_at_tile(*camera, points, z_low, z_high, max_off_nadir_deg));
  weigh_by_gsd(views, cameras, points, 0.5 * (z_low + z_high));
  return views;
}

}  // namespace skysweep::index
