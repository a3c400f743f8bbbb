// SPDX-License-Identifier: Apache-2.0
// Trees: crowns of thousands of small flat leaves with gaps between them. A few prototypes are built; every tree is a
// turned and scaled instance of one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "scene/objects.h"

namespace skysweep::scene {

constexpr int kVariantsPerShape = 3;
constexpr int kTreePrototypes = 3 * kVariantsPerShape;

// A flat quadrilateral in the frame of its prototype: foot at the origin, top of the tree at z = 1, crown within a
// radius of 1. Seen from both sides.
struct Leaf {
  std::array<Vec3d, 4> corner;
  bool bark = false;  // part of the trunk
};

// Radius of the crown at a share of the tree's height; below 0 where there is no crown.
double crown_radius(CrownShape shape, double height_share);

// `prototype` = kVariantsPerShape * shape + variant. The same leaves in every scene.
std::vector<Leaf> make_tree(int prototype);

struct TreeInstance {
  int prototype = 0;
  Vec3d foot;
  double radius_m = 1, height_m = 1;
  Vec2d axis{1, 0};  // where the prototype's x axis points
  std::uint32_t seed = 0;

  // From the scene into the prototype's frame. Distances along a ray, in units of its direction, stay as they are.
  Vec3d direction_to_prototype(Vec3d d) const {
    return {dot({d.x, d.y}, axis) / radius_m, dot({d.x, d.y}, Vec2d{-axis.y, axis.x}) / radius_m, d.z / height_m};
  }
  Vec3d point_to_prototype(Vec3d p) const { return direction_to_prototype(p - foot); }
  // And back.
  Vec3d direction_to_scene(Vec3d d) const {
    return {radius_m * (axis.x * d.x - axis.y * d.y), radius_m * (axis.y * d.x + axis.x * d.y), height_m * d.z};
  }
};

TreeInstance plant(CrownShape shape, Vec3d foot, double height_m, double crown_m, std::uint64_t seed);

}  // namespace skysweep::scene
