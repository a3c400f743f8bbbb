// SPDX-License-Identifier: Apache-2.0
// A line of straight pieces, drawn through corners: level, slope, level; or a stair of benches. Each corner is sharp or
// rounded by a parabola.
#pragma once

#include <vector>

#include "scene/world/terrain/surface.h"

namespace skysweep::scene {

class Profile {
 public:
  struct Corner {
    double u = 0, z = 0;
  };
  // `corners` in ascending u, at least two; level before the first and after the last. With a rounding > 0 the slope
  // changes linearly over that width about each corner; the width must not exceed the distance between corners.
  Profile(std::vector<Corner> corners, double rounding_m);

  struct Sample {
    double z = 0, slope = 0;
  };
  Sample at(double u) const;
  HeightRange heights(double u_low, double u_high) const;
  // Bounds on (low, high), its ends left out: on the second derivative, sharp corners apart, and on the slope.
  double curvature(double u_low, double u_high) const;
  double steepest(double u_low, double u_high) const;

  // Where the second derivative jumps: the corners, or both ends of each rounding.
  std::vector<double> creases() const;
  double rounding_m() const { return rounding_m_; }

 private:
  // Slope of the piece after corner i; that before the first corner is i = -1.
  double slope_after(int i) const;
  // Index of the last corner at or before u, or -1.
  int corner_before(double u) const;

  std::vector<Corner> corners_;
  double rounding_m_;
};

// A profile along one direction, the same everywhere across it.
class ProfileSurface final : public TerrainSurface {
 public:
  // u = 0 at `center`.
  ProfileSurface(Profile profile, double azimuth_deg, Vec2d center);

  HeightSample at(Vec2d p) const override;
  HeightRange heights(const Box2d& box) const override;
  MeshPlan mesh_plan() const override;
  double curvature(const Box2d& box) const override;

 private:
  Profile profile_;
  Vec2d axis_u_;
  double u_of_center_;
};

}  // namespace skysweep::scene
