// SPDX-License-Identifier: Apache-2.0
#include "scene/world/tree_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kTreeStream = 0x72ee;
constexpr int kLeaves = 11000, kBoughs = 70;
constexpr double kHalfLeaf = 0.019;      // half side of a leaf, crown radii
constexpr double kBoughRadius = 0.26;    // of the ball of leaves around the tip of a bough, crown radii
constexpr double kRadiusToHeight = 0.3;  // shape of a typical tree: makes balls of the boughs, squares of the leaves

double crown_base(CrownShape shape) {
  switch (shape) {
    case CrownShape::ellipsoid: return 0.25;
    case CrownShape::cone: return 0.12;
    default: return 0.10;
  }
}

Vec3d random_direction(Random& random) {
  const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// From lengths in crown radii to the frame of the prototype.
Vec3d flattened(Vec3d v) { return {v.x, v.y, kRadiusToHeight * v.z}; }

bool within_crown(CrownShape shape, Vec3d p) { return std::sqrt(p.x * p.x + p.y * p.y) <= crown_radius(shape, p.z); }

// Tips of boughs: evenly over the height where the crown is wide, more of them outside than inside.
Vec3d bough_tip(CrownShape shape, Random& random) {
  for (;;) {
    const double z = random.uniform(crown_base(shape), 1);
    const double radius = crown_radius(shape, z);
    if (random.uniform() > radius + 0.05) continue;
    const double r = radius * std::sqrt(random.uniform(0.02, 0.95)), angle = random.uniform(0, 2 * std::numbers::pi);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
}

// Four sides that taper towards the middle of the crown.
void add_trunk(CrownShape shape, std::vector<Leaf>& leaves) {
  constexpr double kHalf = 0.05, kHalfAtTop = 0.008, kBelowGround = -0.1;
  const double top = 0.5 * (crown_base(shape) + 1);
  constexpr std::array<Vec2d, 4> kCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2d a = kHalf * kCorners[k], b = kHalf * kCorners[(k + 1) % 4];
    const Vec2d c = kHalfAtTop * kCorners[(k + 1) % 4], d = kHalfAtTop * kCorners[k];
    leaves.push_back(
        {{Vec3d{a.x, a.y, kBelowGround}, {b.x, b.y, kBelowGround}, {c.x, c.y, top}, {d.x, d.y, top}}, true});
  }
}

}  // namespace

double crown_radius(CrownShape shape, double height_share) {
  const double base = crown_base(shape);
  if (height_share < base || height_share > 1) return -1;
  const double from_middle = (height_share - 0.5 * (base + 1)) / (0.5 * (1 - base));  // -1 to 1
  switch (shape) {
    case CrownShape::ellipsoid: return std::sqrt(std::max(0.0, 1 - from_middle * from_middle));
    case CrownShape::cone: return (1 - height_share) / (1 - base);
    default: return std::pow(std::max(0.0, 1 - std::pow(from_middle, 4)), 0.25);
  }
}

std::vector<Leaf> make_tree(int prototype) {
  const auto shape = static_cast<CrownShape>(prototype / kVariantsPerShape);
  Random random(mix64(kTreeStream) ^ static_cast<std::uint64_t>(prototype));
  std::vector<Vec3d> tips;
  for (int i = 0; i < kBoughs; ++i) tips.push_back(bough_tip(shape, random));
  std::vector<Leaf> leaves;
  add_trunk(shape, leaves);
  const std::size_t wanted = leaves.size() + kLeaves;
  while (leaves.size() < wanted) {
    const Vec3d& tip = tips[static_cast<std::size_t>(random.below(kBoughs))];
    const Vec3d outwards = random_direction(random);
    const Vec3d middle = tip + flattened(kBoughRadius * std::cbrt(random.uniform(0.2, 1)) * outwards);
    // Leaves look away from the middle of their bough and a little upwards, none quite like the other.
    const Vec3d normal = normalized(outwards + Vec3d{0, 0, 0.4} + 0.7 * random_direction(random));
    const Vec3d across = normalized(cross(normal, std::abs(normal.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}));
    const Vec3d s = kHalfLeaf * across, t = kHalfLeaf * cross(normal, across);
    const Leaf leaf{
        {middle + flattened(-s - t), middle + flattened(s - t), middle + flattened(s + t), middle + flattened(t - s)}};
    if (std::all_of(leaf.corner.begin(), leaf.corner.end(), [&](Vec3d p) { return within_crown(shape, p); }))
      leaves.push_back(leaf);
  }
  return leaves;
}

TreeInstance plant(CrownShape shape, Vec3d foot, double height_m, double crown_m, std::uint64_t seed) {
  Random random(seed);
  TreeInstance out;
  out.prototype = kVariantsPerShape * static_cast<int>(shape) + random.below(kVariantsPerShape);
  out.foot = foot;
  out.radius_m = 0.5 * crown_m;
  out.height_m = height_m;
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  out.axis = {std::cos(angle), std::sin(angle)};
  out.seed = static_cast<std::uint32_t>(random.next());
  return out;
}

}  // namespace skysweep::scene
