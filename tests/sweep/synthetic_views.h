// SPDX-License-Identifier: Apache-2.0
// Photographs of surfaces given by a formula, rendered pixel by pixel through camera::Camera: truth for the sweep's
// tests that shares no code with it.
#pragma once

#include <cmath>
#include <deque>
#include <functional>
#include <vector>

#include "camera/camera.h"
#include "core/random.h"
#include "sweep/sweep_problem.h"

namespace skysweep::test {

using Surface = std::function<double(double x, double y)>;

// Smooth noise in [0, 1] without repetition: value noise on the integer lattice, cubic between.
inline double value_noise(double x, double y, std::uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto lattice = [&](double dx, double dy) {
    const auto ix = static_cast<std::int64_t>(fx + dx), iy = static_cast<std::int64_t>(fy + dy);
    return static_cast<double>(mix64(mix64(seed + static_cast<std::uint64_t>(ix)) + static_cast<std::uint64_t>(iy)) >>
                               11) *
           0x1.0p-53;
  };
  const auto ease = [](double t) { return t * t * (3 - 2 * t); };
  const double u = ease(x - fx), v = ease(y - fy);
  const double south = lattice(0, 0) + u * (lattice(1, 0) - lattice(0, 0));
  const double north = lattice(0, 1) + u * (lattice(1, 1) - lattice(0, 1));
  return south + v * (north - south);
}

// Grey level of the ground at a place: five octaves from 3 m down to 0.2 m.
inline double ground_texture(double x, double y) {
  double grey = 128, amplitude = 60, size = 3;
  for (int octave = 0; octave < 5; ++octave, size /= 2, amplitude *= 0.75)
    grey += amplitude * (value_noise(x / size, y / size, 17 + octave) - 0.5);
  return std::fmin(255, std::fmax(0, grey));
}

// Where a ray meets a surface whose slope is gentle: fixed-point iteration on the height.
inline Vec2d ground_point(const camera::Camera& camera, Vec2d pixel, const Surface& surface, bool& hit) {
  hit = false;
  const auto ray = camera.ray(pixel);
  if (!ray || ray->z >= -0.05) return {};
  const Vec3d c = camera.pose().center;
  double z = 0;
  Vec2d p;
  for (int i = 0; i < 60; ++i) {
    const double t = (z - c.z) / ray->z;
    p = {c.x + t * ray->x, c.y + t * ray->y};
    z = surface(p.x, p.y);
  }
  hit = true;
  return p;
}

inline Array2d<Rgb8> photograph_of(const camera::Camera& camera, const Surface& surface) {
  Array2d<Rgb8> image(camera.model().width_px, camera.model().height_px);
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      double sum = 0;
      for (int s = 0; s < 4; ++s) {
        bool hit = false;
        const Vec2d p = ground_point(camera, {column + 0.25 + 0.5 * (s % 2), row + 0.25 + 0.5 * (s / 2)}, surface, hit);
        if (hit) sum += ground_texture(p.x, p.y) / 4;
      }
      const auto grey = static_cast<std::uint8_t>(sum + 0.5);
      image(column, row) = {grey, grey, grey};
    }
  }
  return image;
}

// A problem together with the photographs it points to.
struct SyntheticProblem {
  sweep::SweepProblem problem;
  std::deque<sweep::ImagePyramid> images;  // a deque: addresses stay

  void add_view(const camera::CameraModel& model, const camera::Pose& pose, const Surface& surface) {
    const camera::Camera camera(model, pose);
    images.emplace_back(photograph_of(camera, surface));
    problem.views.push_back({&images.back(), camera, 0});
  }
};

inline camera::CameraModel small_camera(double focal_px = 300, int width = 320, int height = 240) {
  return {width, height, focal_px, focal_px, width / 2.0, height / 2.0, {}};
}

// `count` cameras at about 30 m above z = 0 on a ring around the origin, slightly tilted and turned, seeded.
inline SyntheticProblem ring_of_views(int count, const camera::CameraModel& model, const Surface& surface,
                                      std::uint64_t seed = 1, double radius_m = 6) {
  SyntheticProblem out;
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count;
    const Vec3d center =
        camera::snap_position({radius_m * std::cos(angle) + random.uniform(-0.5, 0.5),
                               radius_m * std::sin(angle) + random.uniform(-0.5, 0.5), 30 + random.uniform(-1.0, 1.0)});
    const Mat3d rotation = camera::rotation_from_yaw_pitch_roll(random.uniform(0, 360), -90 + random.uniform(-4, 4),
                                                                random.uniform(-4, 4));
    out.add_view(model, {rotation, center}, surface);
  }
  return out;
}

// Cells of `cell_m` around the origin, searching z_low..z_high everywhere.
inline void set_grid(sweep::SweepProblem& problem, int cells, double cell_m, double dz_m, double z_low, double z_high) {
  problem.grid = {cells, cells, cell_m, {-0.5 * cells * cell_m, 0.5 * cells * cell_m}};
  problem.dz_m = dz_m;
  problem.search_everywhere(sweep::planes_between(z_low, z_high, dz_m, 0));
}

}  // namespace skysweep::test
