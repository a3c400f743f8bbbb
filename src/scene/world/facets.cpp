// SPDX-License-Identifier: Apache-2.0
#include "scene/world/facets.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace skysweep::scene {
namespace {

Vec3d plane_normal(const std::vector<Vec3d>& corners) {
  // Newell's sum: every corner counts, so that three nearly in line do no harm.
  Vec3d sum;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum = sum + cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  if (sum.x == 0 && sum.y == 0) return {0, 0, sum.z > 0 ? 1.0 : -1.0};
  Vec3d normal = normalized(sum);
  constexpr double kRounding = 1e-12;
  if (std::abs(normal.z) < kRounding) normal.z = 0;  // upright
  return normal;
}

}  // namespace

int Facets::add_body(const Body& body) {
  bodies.push_back(body);
  return static_cast<int>(bodies.size()) - 1;
}

void Facets::add_polygon(const std::vector<Vec3d>& corners, int body, int face) {
  std::vector<Vec3d> distinct;
  for (const Vec3d& corner : corners)
    if (distinct.empty() || !(corner == distinct.back())) distinct.push_back(corner);
  while (distinct.size() > 1 && distinct.back() == distinct.front()) distinct.pop_back();
  if (distinct.size() < 3) return;
  const Vec3d normal = plane_normal(distinct);
  for (std::size_t i = 1; i + 1 < distinct.size(); i += 2) {
    const std::size_t last = std::min(i + 2, distinct.size() - 1);
    all.push_back({{distinct[0], distinct[i], distinct[i + 1], distinct[last]}, normal, body, face});
  }
}

void add_beam(Facets& facets, const Beam& beam, int body) {
  SKY_CHECK(beam.bottom_from < beam.top_from && beam.bottom_to < beam.top_to);
  const Vec2d along = (1 / norm(beam.to - beam.from)) * (beam.to - beam.from);
  const Vec2d left = 0.5 * beam.width_m * Vec2d{-along.y, along.x};
  const auto corner = [](Vec2d p, double z) { return Vec3d{p.x, p.y, z}; };
  const Vec2d from_l = beam.from + left, from_r = beam.from - left, to_l = beam.to + left, to_r = beam.to - left;
  const Vec3d a = corner(from_r, beam.bottom_from), b = corner(to_r, beam.bottom_to), c = corner(to_l, beam.bottom_to),
              d = corner(from_l, beam.bottom_from);
  const Vec3d e = corner(from_r, beam.top_from), f = corner(to_r, beam.top_to), g = corner(to_l, beam.top_to),
              h = corner(from_l, beam.top_from);
  facets.add_polygon({e, f, g, h}, body, 0);
  facets.add_polygon({a, b, f, e}, body, 1);
  facets.add_polygon({b, c, g, f}, body, 2);
  facets.add_polygon({c, d, h, g}, body, 3);
  facets.add_polygon({d, a, e, h}, body, 4);
  facets.add_polygon({d, c, b, a}, body, 5);
}

}  // namespace skysweep::scene
