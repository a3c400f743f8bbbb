// SPDX-License-Identifier: Apache-2.0
// Axis-aligned boxes. A default box is empty and grows by `extend`.
#pragma once

#include <algorithm>
#include <limits>

#include "core/vec.h"

namespace skysweep {

struct Box2d {
  Vec2d min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2d max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y); }
  double width() const { return max.x - min.x; }
  double height() const { return max.y - min.y; }
  void extend(Vec2d p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  bool contains(Vec2d p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
  bool intersects(const Box2d& o) const {
    return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y;
  }
  friend bool operator==(const Box2d&, const Box2d&) = default;
};

struct Box3d {
  Vec3d min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Vec3d max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void extend(Vec3d p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  Box2d ground() const { return {{min.x, min.y}, {max.x, max.y}}; }
  friend bool operator==(const Box3d&, const Box3d&) = default;
};

}  // namespace skysweep
