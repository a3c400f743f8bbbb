// SPDX-License-Identifier: Apache-2.0
#include "index/selection/tally.h"

#include <algorithm>
#include <cmath>

namespace skysweep::index {

double Tally::gain(const TileView& view, Points points) const {
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Sighting& sighting = view.at[i];
    const Point& point = points_[i];
    if (sighting.heights == 0) continue;
    if (points == Points::in_need && point.heights >= options_.views_per_place * kHeights) continue;
    sum += sighting.quality * sighting.heights * spread(point, sighting.ray) / (kHeights + point.heights);
  }
  return sum;
}

void Tally::add(const TileView& view) {
  for (int i = 0; i < kPoints; ++i) {
    const Sighting& sighting = view.at[i];
    if (sighting.heights == 0 || spread(points_[i], sighting.ray) == 0) continue;
    points_[i].heights += sighting.heights;
    points_[i].rays.push_back(sighting.ray);
  }
}

// 0 where the nearest ray is within the smallest useful baseline, 1 from the full one on. The distance between the tips
// of two unit rays is the baseline over the depth.
double Tally::spread(const Point& point, Vec3d ray) const {
  if (point.rays.empty()) return 1;
  double nearest_squared = 4;
  for (const Vec3d other : point.rays) nearest_squared = std::min(nearest_squared, dot(ray - other, ray - other));
  const double ratio = std::sqrt(nearest_squared);
  const double above = ratio - options_.min_baseline_ratio;
  return std::clamp(above / (options_.full_baseline_ratio - options_.min_baseline_ratio), 0.0, 1.0);
}

}  // namespace skysweep::index
