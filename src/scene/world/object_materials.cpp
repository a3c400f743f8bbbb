// SPDX-License-Identifier: Apache-2.0
// Looks of facets and leaves: the part of Materials that belongs to objects other than boxes.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"
#include "scene/world/materials.h"
#include "scene/world/noise.h"

namespace skysweep::scene {
namespace {

constexpr LinearRgb kConcrete{0.36f, 0.35f, 0.33f}, kMasonry{0.34f, 0.27f, 0.21f}, kRoadway{0.13f, 0.13f, 0.135f},
    kSteel{0.40f, 0.41f, 0.42f}, kWire{0.10f, 0.10f, 0.11f}, kPane{0.09f, 0.11f, 0.12f}, kBark{0.10f, 0.075f, 0.05f};
// Of a broad crown, a fir and a poplar: CrownShape.
constexpr std::array<LinearRgb, 3> kFoliage = {
    {{0.115f, 0.185f, 0.050f}, {0.055f, 0.110f, 0.050f}, {0.095f, 0.165f, 0.060f}}};

// Coordinates in the plane of a facet: along its level lines, and down its slope.
Vec2d in_plane(const Facet& facet, const SolidBox& place, Vec3d p) {
  const Vec3d from{p.x - place.center.x, p.y - place.center.y, p.z - place.z_high};
  const Vec3d n = facet.normal;
  const double h = std::hypot(n.x, n.y);
  if (h < 1e-9) return place.local({p.x, p.y});
  const Vec3d level{-n.y / h, n.x / h, 0};
  return {dot(from, level), -dot(from, cross(n, level))};
}

}  // namespace

LinearRgb Materials::facet(const SurfacePoint& point) const {
  const Facet& facet = solids_.facets.all[static_cast<std::size_t>(point.facet)];
  const Body& body = solids_.facets.bodies[static_cast<std::size_t>(facet.body)];
  // Faces of one body must not show the same stains: each looks at a part of the pattern of its own.
  const Vec2d own = in_plane(facet, body.place, point.position) + facet.face * Vec2d{61.3, 47.9};
  if (body.kind == BodyKind::building) return point.face == Face::top ? top(body.place, own) : wall(body.place, point);

  const std::uint32_t seed = seed_ + 81 + 16 * static_cast<std::uint32_t>(facet.body);
  const auto rough = [&](LinearRgb color, float strength) {
    const float fine = value_noise(per_finest_ * own.x, per_finest_ * own.y, seed);
    const float middle = value_noise(per_finest_ * own.x / 4, per_finest_ * own.y / 4, seed + 1);
    const float stain = value_noise(own.x / 2.3, own.y / 2.3, seed + 2);
    return std::max(0.1f, 1 + contrast_ * strength * (fine + middle + 0.6f * stain)) * color;
  };
  switch (body.kind) {
    case BodyKind::glazing: {  // panes between bars; the same on every tooth, which share their seed
      const double pane = own.x / 1.2;
      const int i = floor_int(pane);
      if (pane - i < 0.08) return kSteel;
      const float tone = 0.35f * lattice_value(i, floor_int(own.y / 1.8), body.place.seed + 82);
      return (1 + contrast_ * tone) * kPane;
    }
    case BodyKind::bridge: {
      if (point.face != Face::top) return rough(kConcrete, 0.15f);
      const Vec2d v = body.place.axis_v();
      const Vec3d sideways{v.x, v.y, 0};
      const double across = std::abs(dot(point.position - facet.corner[0], sideways));
      const double width = std::abs(dot(facet.corner[3] - facet.corner[0], sideways));
      const bool kerb = std::min(across, width - across) < 0.12 * width;
      return kerb ? rough(kConcrete, 0.2f) : rough(kRoadway, 0.3f);
    }
    case BodyKind::wall: return rough(kMasonry, 0.3f);
    case BodyKind::wire: return kWire;
    default: return rough(kSteel, 0.05f);
  }
}

LinearRgb Materials::leaf(const SurfacePoint& point) const {
  const TreeInstance& tree = solids_.trees[static_cast<std::size_t>(point.tree)];
  constexpr int kTrunkFaces = 4;
  const Vec3d p = point.position;
  const auto grain = [&](float strength) {
    const float fine = value_noise(per_finest_ * (p.x + 0.7 * p.z), per_finest_ * (p.y - 0.7 * p.z), tree.seed);
    return 1 + contrast_ * strength * fine;
  };
  if (point.leaf < kTrunkFaces) return grain(0.3f) * kBark;
  // Each tree has its green, each leaf its brightness.
  const auto shape = static_cast<std::size_t>(tree.prototype / kVariantsPerShape);
  const float yellow = lattice_value(0, 1, tree.seed), bright = 0.25f * lattice_value(0, 2, tree.seed);
  const float tone = contrast_ * 0.35f * lattice_value(point.leaf, 3, tree.seed);
  LinearRgb color = kFoliage[shape];
  color.r *= 1 + 0.3f * yellow;
  return std::max(0.1f, (1 + bright) * (1 + tone) * grain(0.25f)) * color;
}

}  // namespace skysweep::scene
