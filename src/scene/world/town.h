// SPDX-License-Identifier: Apache-2.0
// What stands on the ground: boxes with level tops, and the plan of the streets between them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/ground.h"

namespace skysweep::scene {

enum class BoxKind { building, roof_unit, car };

struct SolidBox {
  BoxKind kind = BoxKind::building;
  Vec2d center;
  Vec2d axis_u{1, 0};  // horizontal unit vector of side u; side v is turned left from it
  Vec2d half;          // half sides along u and v
  double z_low = 0, z_high = 0;
  std::uint32_t seed = 0;  // of its looks

  Vec2d axis_v() const { return {-axis_u.y, axis_u.x}; }
  Vec2d local(Vec2d p) const { return {dot(p - center, axis_u), dot(p - center, axis_v())}; }
};

// The regular grid of streets, in a frame turned by the town's heading about the middle of the mapped area.
class StreetPlan {
 public:
  StreetPlan(const Town& town, Vec2d middle);

  Vec2d to_plan(Vec2d p) const { return {dot(p - middle_, axis_u_), dot(p - middle_, axis_v_)}; }
  Vec2d from_plan(Vec2d q) const { return middle_ + q.x * axis_u_ + q.y * axis_v_; }
  Vec2d axis_u() const { return axis_u_; }

  // A position relative to the block it lies in or nearest to.
  struct Place {
    int block_x = 0, block_y = 0;
    Vec2d in_block;  // from the block's centre, metres
    Vec2d outside;   // how far beyond the block's sides, i.e. into a street; 0 within
  };
  Place place(Vec2d q) const;

  double pitch_m() const { return block_m_ + street_m_; }
  double block_m() const { return block_m_; }
  double street_m() const { return street_m_; }

 private:
  double block_m_, street_m_, per_pitch_;
  Vec2d middle_, axis_u_, axis_v_;
};

// All boxes that may be seen on `extent`. A block looks the same however large the extent is.
std::vector<SolidBox> build_boxes(const Scene& scene, const Ground& ground, const std::optional<StreetPlan>& streets,
                                  const Box2d& extent);

}  // namespace skysweep::scene
