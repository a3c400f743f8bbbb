// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/koch.h"

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kCoastStream = 0xc0a5;
constexpr double kInwards = 0.25;        // share of bumps that are bays
constexpr double kLowestBump = 0.55;     // of the height of Koch's own, which has equal sides
const double kKoch = std::sqrt(3.) / 6;  // its height over the length of the piece it stands on

// Appends the corners of the curve from a (included) to b (left out).
void add_curve(Vec2d a, Vec2d b, int depth, Random& random, std::vector<Vec2d>& out) {
  if (depth == 0) {
    out.push_back(a);
    return;
  }
  const Vec2d along = b - a, outwards{along.y, -along.x};
  const double side = random.uniform() < kInwards ? -1 : 1;
  const double height = side * kKoch * random.uniform(kLowestBump, 1);
  const Vec2d third = a + (1. / 3) * along, tip = a + 0.5 * along + height * outwards,
              two_thirds = a + (2. / 3) * along;
  add_curve(a, third, depth - 1, random, out);
  add_curve(third, tip, depth - 1, random, out);
  add_curve(tip, two_thirds, depth - 1, random, out);
  add_curve(two_thirds, b, depth - 1, random, out);
}

}  // namespace

std::vector<Vec2d> koch_outline(Vec2d center, double radius_m, int depth, std::uint64_t seed) {
  Random random(mix64(seed) ^ kCoastStream);
  const double turn = random.uniform(0, 2 * std::numbers::pi);
  const auto corner = [&](int i) {
    const double angle = turn + 2 * std::numbers::pi * i / 3;
    return center + radius_m * Vec2d{std::cos(angle), std::sin(angle)};
  };
  std::vector<Vec2d> out;
  for (int side = 0; side < 3; ++side) add_curve(corner(side), corner((side + 1) % 3), depth, random, out);
  return out;
}

}  // namespace skysweep::scene
