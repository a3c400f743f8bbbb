// SPDX-License-Identifier: Apache-2.0
#include "report/step_displacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "height_cells.h"

namespace skysweep::report {
namespace {

constexpr double kGsd = 0.05;
constexpr double kEave = 8, kGround = 2;

// A wall through the middle of a map of 64 x 64 cells. Heights are sampled at the centres of cells, or are the mean of
// each cell; the normal points to the ground.
struct Wall {
  double cell_m = kGsd;
  double angle_deg = 0;       // of the normal, from east to north
  double displacement_m = 0;  // along the normal

  float height(Vec2d p, int samples) const {
    const double angle = angle_deg * std::numbers::pi / 180;
    const Vec2d normal{std::cos(angle), std::sin(angle)};
    const double wall = 32.37 * cell_m * (normal.x + normal.y) + displacement_m;
    int high = 0;
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        const Vec2d offset{(i + 0.5) / samples - 0.5, (j + 0.5) / samples - 0.5};
        high += dot(p + cell_m * offset, normal) < wall;
      }
    return static_cast<float>(kGround + (kEave - kGround) * high / (samples * samples));
  }
};

StepDisplacement displacement_of(Wall wall, double displacement_m, int samples) {
  Wall moved = wall;
  moved.displacement_m = displacement_m;
  const auto height_of = [samples](const Wall& w) { return [w, samples](Vec2d p) { return w.height(p, samples); }; };
  return step_displacement(make_cells(64, 64, wall.cell_m, height_of(wall), height_of(moved)), 1, kGsd, nullptr);
}

TEST(StepDisplacement, a_grown_or_shrunk_building_is_found_to_a_twentieth_of_the_gsd) {
  for (const double angle : {0., 90., 180., 270., 23., 45., 118., 251.})
    for (const double gsd : {0.3, -0.3, 1.0, -1.7, 0.0}) {
      const StepDisplacement d = displacement_of({kGsd, angle}, gsd * kGsd, 20);
      EXPECT_GT(d.steps, 20) << angle;
      EXPECT_GE(d.found, 0.95 * d.steps) << angle;
      EXPECT_NEAR(d.median_m / kGsd, gsd, 0.05) << angle;
      EXPECT_NEAR(d.mean_m / kGsd, gsd, 0.05) << angle;
      EXPECT_NEAR(d.median_absolute_m / kGsd, std::abs(gsd), 0.05) << angle;
    }
}

TEST(StepDisplacement, oblique_walls_sampled_at_centres_show_it_to_a_sixteenth_of_a_cell) {
  for (const double angle : {17., 62., 205.})
    for (const double gsd : {0.3, -0.3}) {
      const double found_m = displacement_of({2 * kGsd, angle}, gsd * kGsd, 1).mean_m;
      EXPECT_NEAR(found_m, gsd * kGsd, 2 * kGsd / 16) << angle;
    }
}

TEST(StepDisplacement, quantiles_enclose_the_median) {
  const StepDisplacement d = displacement_of({kGsd, 30}, 0.3 * kGsd, 1);
  EXPECT_LE(d.p5_m, d.median_m);
  EXPECT_GE(d.p95_m, d.median_m);
  EXPECT_EQ(d.reach_m, 6 * kGsd);
}

TEST(StepDisplacement, no_step_no_displacement) {
  const auto slope = [](Vec2d p) { return static_cast<float>(p.x); };
  const StepDisplacement d = step_displacement(make_cells(64, 64, kGsd, slope, slope), 1, kGsd, nullptr);
  EXPECT_EQ(d.steps, 0);
  EXPECT_EQ(d.found, 0);
  EXPECT_TRUE(std::isnan(d.median_m));
  EXPECT_TRUE(std::isnan(d.mean_m));
}

TEST(StepDisplacement, a_step_that_was_not_measured_is_not_found) {
  const Wall wall;
  const auto truth = [&](Vec2d p) { return wall.height(p, 1); };
  const auto flat = [](Vec2d) { return static_cast<float>(kGround); };
  const auto holes = [&](Vec2d p) { return p.x > 28 * kGsd && p.x < 30 * kGsd ? kHole : wall.height(p, 1); };
  for (const StepDisplacement& d : {step_displacement(make_cells(64, 64, kGsd, truth, flat), 1, kGsd, nullptr),
                                    step_displacement(make_cells(64, 64, kGsd, truth, holes), 1, kGsd, nullptr)}) {
    EXPECT_GT(d.steps, 20);
    EXPECT_EQ(d.found, 0);
  }
}

TEST(StepDisplacement, only_steps_of_the_region_count) {
  const Wall wall;
  const auto truth = [&](Vec2d p) { return wall.height(p, 1); };
  const HeightDifferences cells = make_cells(64, 64, kGsd, truth, truth);
  const std::int64_t all = step_displacement(cells, 1, kGsd, nullptr).steps;
  Array2d<std::uint8_t> region(64, 64);
  EXPECT_EQ(step_displacement(cells, 1, kGsd, &region).steps, 0);
  for (int row = 20; row < 30; ++row)
    for (int column = 0; column < 64; ++column) region(column, row) = 1;
  EXPECT_EQ(step_displacement(cells, 1, kGsd, &region).steps, 10);
  EXPECT_GT(all, 40);
}

TEST(StepDisplacement, noise_on_the_heights_does_not_bias_it) {
  const Wall wall{kGsd, 30}, moved{kGsd, 30, 0.3 * kGsd};
  Random random(3);
  const auto noisy = [&](Vec2d p) { return moved.height(p, 8) + static_cast<float>(0.1 * random.normal()); };
  const StepDisplacement d = step_displacement(make_cells(
                                                   64, 64, kGsd, [&](Vec2d p) { return wall.height(p, 8); }, noisy),
                                               1, kGsd, nullptr);
  EXPECT_GT(d.found, 20);
  EXPECT_NEAR(d.median_m / kGsd, 0.3, 0.05);
}

}  // namespace
}  // namespace skysweep::report
