// SPDX-License-Identifier: Apache-2.0
// What photographs show of a tile and how well, at a grid of sample points.
#pragma once

#include <array>
#include <vector>

#include "camera/camera.h"
#include "core/box.h"
#include "core/vec.h"

namespace skysweep::index {

constexpr int kPointsPerSide = 8;  // from border to border, corners included
constexpr int kPoints = kPointsPerSide * kPointsPerSide;
constexpr int kHeights = 3;  // the lowest, middle and highest height that the ground may have

// One photograph at one point of the tile.
struct Sighting {
  int heights =
      0;  // so many of the kHeights are in the photograph; 0 also when it looks too steeply: it does not count
  double quality = 0;  // 1 straight from above at the finest GSD of all, falling to 0 at the largest angle from nadir
  Vec3d ray;           // unit vector from the point, at the middle height, to the CoP
};

// One photograph over the whole tile.
struct TileView {
  std::array<Sighting, kPoints> at;
  double coverage = 0;                // share of all points and heights in the photograph, at whatever angle
  double smallest_off_nadir_deg = 0;  // over the points in the photograph; meaningless when coverage is 0
};

// In the order of the cameras, which are in the tile's frame.
std::vector<TileView> tile_views(const std::vector<const camera::Camera*>& cameras, const Box2d& tile, double z_low,
                                 double z_high, double max_off_nadir_deg);

}  // namespace skysweep::index
