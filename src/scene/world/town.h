// SPDX-License-Identifier: Apache-2.0
// A town: the plan of its streets, and the blocks of buildings, cars and trees between them.
#pragma once

#include <cstdint>
#include <optional>

#include "core/box.h"
#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/ground.h"

namespace skysweep::scene {

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

  Vec2d pitch_m() const { return {block_m_.x + street_m_, block_m_.y + street_m_}; }
  Vec2d block_m() const { return block_m_; }
  double street_m() const { return street_m_; }
  // Middle of a block, in the plan.
  Vec2d block_center(int block_x, int block_y) const { return {pitch_m().x * block_x, pitch_m().y * block_y}; }

 private:
  Vec2d block_m_;
  double street_m_;
  Vec2d per_pitch_;
  Vec2d middle_, axis_u_, axis_v_;
};

struct Solids;

// Adds the blocks whose centre lies in `extent`. A block looks the same however large the extent is. No buildings stand
// on the blocks whose centre lies in the scene's forest.
void build_town(const Scene& scene, const StreetPlan& streets, const Ground& ground, const Box2d& extent,
                Solids& solids);

}  // namespace skysweep::scene
