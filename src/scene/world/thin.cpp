// SPDX-License-Identifier: Apache-2.0
#include "scene/world/thin.h"

#include <algorithm>
#include <cmath>

namespace skysweep::scene {
namespace {

constexpr double kFoundation_m = 1;  // how far below the ground things reach

// The frame of colours along something from one place to another.
Body body_along(BodyKind kind, Vec2d from, Vec2d to, double z) {
  SolidBox place;
  place.center = from;
  place.axis_u = (1 / norm(to - from)) * (to - from);
  place.z_high = z;
  return {kind, place};
}

void add_post(Facets& facets, BodyKind kind, Vec2d foot, double ground_z, double height_m, double width_m) {
  const Vec2d half{0.5 * width_m, 0};
  const int body = facets.add_body(body_along(kind, foot - half, foot + half, ground_z + height_m));
  add_beam(facets,
           {foot - half, foot + half, width_m, ground_z + height_m, ground_z + height_m, ground_z - kFoundation_m,
            ground_z - kFoundation_m},
           body);
}

void add_wire(Facets& facets, Vec3d from, Vec3d to, double sag_m, double diameter_m, int body) {
  const auto at = [&](int piece) {
    const double t = static_cast<double>(piece) / kWirePieces;
    return from + t * (to - from) - Vec3d{0, 0, 4 * sag_m * t * (1 - t)};
  };
  for (int i = 0; i < kWirePieces; ++i) {
    const Vec3d a = at(i), b = at(i + 1);
    const double r = 0.5 * diameter_m;
    add_beam(facets, {{a.x, a.y}, {b.x, b.y}, diameter_m, a.z + r, b.z + r, a.z - r, b.z - r}, body);
  }
}

// Across the line: halfway between the directions of the spans that meet at a pylon.
Vec2d cross_arm_direction(const std::vector<Vec2d>& pylons, std::size_t i) {
  Vec2d along;
  if (i > 0) along = along + (1 / norm(pylons[i] - pylons[i - 1])) * (pylons[i] - pylons[i - 1]);
  if (i + 1 < pylons.size()) along = along + (1 / norm(pylons[i + 1] - pylons[i])) * (pylons[i + 1] - pylons[i]);
  if (!(norm(along) > 1e-9)) along = pylons[i] - pylons[i - 1];  // the line turns back
  return (1 / norm(along)) * Vec2d{-along.y, along.x};
}

}  // namespace

void add_wall(Facets& facets, const FreeWall& wall, const Ground& ground) {
  constexpr double kPiece_m = 2;
  const double length = norm(wall.to - wall.from);
  const int pieces = ground.level() ? 1 : static_cast<int>(std::ceil(length / kPiece_m));
  const int body = facets.add_body(body_along(BodyKind::wall, wall.from, wall.to, wall.height_m));
  const auto at = [&](int piece) { return wall.from + (static_cast<double>(piece) / pieces) * (wall.to - wall.from); };
  for (int i = 0; i < pieces; ++i) {
    const Vec2d a = at(i), b = at(i + 1);
    const double za = ground.at(a).z, zb = ground.at(b).z;
    add_beam(facets,
             {a, b, wall.thickness_m, za + wall.height_m, zb + wall.height_m, za - kFoundation_m, zb - kFoundation_m},
             body);
  }
}

void add_bridge(Facets& facets, const Bridge& bridge, const Ground& ground) {
  const double top = bridge.deck_z_m, bottom = top - bridge.thickness_m;
  add_beam(facets, {bridge.from, bridge.to, bridge.width_m, top, top, bottom, bottom},
           facets.add_body(body_along(BodyKind::bridge, bridge.from, bridge.to, top)));
  if (!(bridge.ramp_m > 0)) return;
  const Vec2d along = (1 / norm(bridge.to - bridge.from)) * (bridge.to - bridge.from);
  const auto add_ramp = [&](Vec2d deck_end, Vec2d outwards) {
    const Vec2d foot = deck_end + bridge.ramp_m * outwards;
    const double foot_z = ground.at(foot).z, below = ground.at(deck_end).z - kFoundation_m;
    add_beam(
        facets,
        {deck_end, foot, bridge.width_m, top, foot_z, std::min(below, top - kFoundation_m), foot_z - kFoundation_m},
        facets.add_body(body_along(BodyKind::bridge, deck_end, foot, top)));
  };
  add_ramp(bridge.from, -1.0 * along);
  add_ramp(bridge.to, along);
}

void add_mast(Facets& facets, const Mast& mast, const Ground& ground) {
  add_post(facets, BodyKind::mast, mast.position, ground.at(mast.position).z, mast.height_m, mast.width_m);
}

void add_power_line(Facets& facets, const PowerLine& line, const Ground& ground) {
  std::vector<std::vector<Vec3d>> ends;  // of the wires, at each pylon
  for (std::size_t i = 0; i < line.pylons.size(); ++i) {
    const Vec2d foot = line.pylons[i], across = cross_arm_direction(line.pylons, i);
    const double ground_z = ground.at(foot).z, top = ground_z + line.height_m;
    add_post(facets, BodyKind::mast, foot, ground_z, line.height_m, line.pylon_width_m);
    const double reach = 0.5 * (line.wires - 1) * line.wire_spacing_m;
    if (line.wires > 1) {
      const double thickness = 0.5 * line.pylon_width_m;
      const Vec2d left = foot - reach * across, right = foot + reach * across;
      add_beam(facets, {left, right, thickness, top, top, top - thickness, top - thickness},
               facets.add_body(body_along(BodyKind::mast, left, right, top)));
    }
    ends.emplace_back();
    for (int w = 0; w < line.wires; ++w) {
      const Vec2d p = foot + (w * line.wire_spacing_m - reach) * across;
      ends.back().push_back({p.x, p.y, top});
    }
  }
  const int body = facets.add_body(body_along(BodyKind::wire, line.pylons[0], line.pylons[1], 0));
  for (std::size_t i = 1; i < ends.size(); ++i)
    for (std::size_t w = 0; w < ends[i].size(); ++w)
      add_wire(facets, ends[i - 1][w], ends[i][w], line.sag_m, line.wire_diameter_m, body);
}

}  // namespace skysweep::scene
