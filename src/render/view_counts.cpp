// SPDX-License-Identifier: Apache-2.0
#include "render/view_counts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "index/view_index.h"

namespace skysweep::render {

ViewCounts::ViewCounts(std::vector<camera::Camera> cameras, const Box3d& bounds)
    : cameras_(std::move(cameras)), bounds_(bounds), near_(kBlocks * kBlocks) {
  index::ViewIndex index;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const double reach = norm(bounds.max - bounds.min) + norm(cameras_[i].pose().center - bounds.min);
    index.insert(static_cast<int>(i), camera::view_pyramid_box(cameras_[i], bounds.min.z, reach), true);
  }
  const Vec3d size = bounds.max - bounds.min;
  for (int y = 0; y < kBlocks; ++y)
    for (int x = 0; x < kBlocks; ++x) {
      const Box3d block{
          {bounds.min.x + size.x * x / kBlocks, bounds.min.y + size.y * y / kBlocks, bounds.min.z},
          {bounds.min.x + size.x * (x + 1) / kBlocks, bounds.min.y + size.y * (y + 1) / kBlocks, bounds.max.z}};
      near_[static_cast<std::size_t>(y * kBlocks + x)] = index.query(block);
      most_ = std::max(most_, at(0.5 * (block.min + block.max)));
    }
}

int ViewCounts::block_of(Vec3d place) const {
  const auto share = [](double v, double low, double high) {
    return std::clamp(static_cast<int>(std::floor(kBlocks * (v - low) / std::max(high - low, 1e-9))), 0, kBlocks - 1);
  };
  return share(place.y, bounds_.min.y, bounds_.max.y) * kBlocks + share(place.x, bounds_.min.x, bounds_.max.x);
}

int ViewCounts::at(Vec3d place) const {
  int count = 0;
  for (const int i : near_[static_cast<std::size_t>(block_of(place))]) {
    const camera::Camera& camera = cameras_[static_cast<std::size_t>(i)];
    const std::optional<Vec2d> pixel = camera.project(place);
    count += pixel && camera.shows(*pixel);
  }
  return count;
}

}  // namespace skysweep::render
