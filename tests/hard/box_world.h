// SPDX-License-Identifier: Apache-2.0
// Level ground with level boxes on or above it, photographed through camera::Camera by closed forms in double: towers,
// bridges and mushrooms whose truth no other code of the program has a part in.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "sweep/synthetic_views.h"

namespace skysweep::hard {

struct Box {
  Vec3d low, high;
};

struct BoxWorld {
  double ground_z = 0;
  std::vector<Box> boxes = {};
  double gsd_m = 0.1;  // the texture has detail from 30 down to 2 of these

  // Highest surface at a place.
  double top(double x, double y) const {
    double z = ground_z;
    for (const Box& b : boxes)
      if (x >= b.low.x && x <= b.high.x && y >= b.low.y && y <= b.high.y) z = std::max(z, b.high.z);
    return z;
  }

  // Where the ray first meets a surface; nothing in the sky.
  std::optional<Vec3d> first_hit(Vec3d from, Vec3d direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (const double t = (ground_z - from.z) / direction.z; t > 0) nearest = t;
    for (const Box& b : boxes) {
      double enter = 0, leave = std::numeric_limits<double>::infinity();
      const double o[] = {from.x, from.y, from.z}, d[] = {direction.x, direction.y, direction.z};
      const double low[] = {b.low.x, b.low.y, b.low.z}, high[] = {b.high.x, b.high.y, b.high.z};
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - o[axis]) / d[axis], c = (high[axis] - o[axis]) / d[axis];
        enter = std::max(enter, std::min(a, c));
        leave = std::min(leave, std::max(a, c));
      }
      if (enter < leave && enter > 0) nearest = std::min(nearest, enter);
    }
    if (!std::isfinite(nearest)) return std::nullopt;
    return from + nearest * direction;
  }

  // Texture in all three directions, so that walls have one, too.
  double grey(Vec3d p) const {
    const double scale = 0.1 / gsd_m;
    return test::ground_texture((p.x + 0.37 * p.z) * scale, (p.y - 0.61 * p.z) * scale);
  }
};

using Shade = std::function<double(Vec3d)>;

// Grey photograph with 2 x 2 samples a pixel; the sky is black.
inline Array2d<Rgb8> photograph(const BoxWorld& world, const camera::Camera& camera, const Shade& shade) {
  Array2d<Rgb8> image(camera.model().width_px, camera.model().height_px);
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      double sum = 0;
      for (int s = 0; s < 4; ++s) {
        const auto ray = camera.ray({column + 0.25 + 0.5 * (s % 2), row + 0.25 + 0.5 * (s / 2)});
        const auto point = ray ? world.first_hit(camera.pose().center, *ray) : std::nullopt;
        if (point) sum += shade(*point) / 4;
      }
      const auto grey = static_cast<std::uint8_t>(std::clamp(sum + 0.5, 0.0, 255.0));
      image(column, row) = {grey, grey, grey};
    }
  }
  return image;
}

// Pose at `from` with the middle of the photograph on `at`.
inline camera::Pose looking_at(Vec3d from, Vec3d at, double roll_deg = 0) {
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  const Vec3d d = at - from;
  const double yaw = std::atan2(d.x, d.y) * kDegrees;
  const double pitch = std::atan2(d.z, std::hypot(d.x, d.y)) * kDegrees;
  return {camera::rotation_from_yaw_pitch_roll(yaw, pitch, roll_deg), from};
}

// A problem over a world; the normalised luminance is what every preset uses.
struct WorldProblem {
  BoxWorld world;
  test::SyntheticProblem synthetic;
  sweep::SweepProblem& problem = synthetic.problem;

  explicit WorldProblem(BoxWorld w) : world(std::move(w)) {}
  // Filled by `fill`: for functions that give one back in place.
  WorldProblem(BoxWorld w, const std::function<void(WorldProblem&)>& fill) : world(std::move(w)) { fill(*this); }
  WorldProblem(const WorldProblem&) = delete;

  void add_view(const camera::CameraModel& model, const camera::Pose& pose) {
    add_view(model, pose, [this](Vec3d p) { return world.grey(p); });
  }
  void add_view(const camera::CameraModel& model, const camera::Pose& pose, const Shade& shade) {
    add_image(model, pose, photograph(world, camera::Camera(model, pose), shade));
  }
  void add_image(const camera::CameraModel& model, const camera::Pose& pose, Array2d<Rgb8> image) {
    synthetic.images.emplace_back(std::move(image), problem.options.normalization());
    problem.views.push_back({&synthetic.images.back(), camera::Camera(model, pose), 0});
  }

  // `count` nadir views on a ring, turned against each other.
  void add_ring(int count, const camera::CameraModel& model, double radius_m, double z, const Shade& shade = {}) {
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * (i + 0.3) / count;
      const camera::Pose pose{camera::rotation_from_yaw_pitch_roll(37.0 * i, -90 + (i % 3 - 1), (i % 2) * 2.0 - 1),
                              {radius_m * std::cos(angle), radius_m * std::sin(angle), z}};
      shade ? add_view(model, pose, shade) : add_view(model, pose);
    }
  }

  // Reads each view at the mipmap level whose pixels are between 0.35 and 0.7 of a cell on the ground, as the pipeline.
  void match_levels() {
    for (sweep::View& view : problem.views) {
      const double gsd = view.camera.gsd(view.camera.pose().center.z - world.ground_z);
      view.base_level = std::max(0, static_cast<int>(std::floor(std::log2(problem.grid.cell_m / gsd) - 0.5)));
    }
  }

  // `cells` x `cells` cells around the origin.
  void set_grid(int cells, double cell_m, double dz_m, double z_low, double z_high) {
    test::set_grid(problem, cells, cell_m, dz_m, z_low, z_high);
  }
};

}  // namespace skysweep::hard
