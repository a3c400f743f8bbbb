// SPDX-License-Identifier: Apache-2.0
#include "scene/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "scene/world/ground.h"
#include "scene/world/terrain/island.h"
#include "scene/world/terrain/koch.h"
#include "scene/world/terrain/mesh_lines.h"
#include "terrain_kinds.h"

namespace skysweep::scene {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

TEST(Terrain, the_slope_of_every_kind_is_the_derivative_of_its_height) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    const Ground ground(terrain, 5);
    Random random(1);
    constexpr double kStep = 1e-5;
    int creases = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec2d p{random.uniform(0, 100), random.uniform(0, 100)};
      const Vec2d slope = ground.at(p).slope;
      const Vec2d measured{(ground.at({p.x + kStep, p.y}).z - ground.at({p.x - kStep, p.y}).z) / (2 * kStep),
                           (ground.at({p.x, p.y + kStep}).z - ground.at({p.x, p.y - kStep}).z) / (2 * kStep)};
      if (norm(slope - measured) > 2e-4 * (1 + norm(slope))) ++creases;
    }
    EXPECT_LE(creases, 1) << name;  // a sharp edge between the two points
  }
}

TEST(Terrain, heights_of_every_kind_keep_within_their_bounds) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    const Ground ground(terrain, 5);
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      const Vec2d corner{random.uniform(-20, 100), random.uniform(-20, 100)};
      const Box2d box{corner, corner + Vec2d{random.uniform(0, 20), random.uniform(0, 20)}};
      const HeightRange range = ground.heights(box);
      for (int k = 0; k < 20; ++k) {
        const double z = ground.surface_m({random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y)});
        ASSERT_GE(z, range.lowest - 1e-12) << name;
        ASSERT_LE(z, range.highest + 1e-12) << name;
      }
    }
  }
}

// By differences of slopes, in cells of the size a mesh has.
TEST(Terrain, no_second_derivative_exceeds_the_bound_that_rays_rely_on) {
  for (const auto& [name, terrain] : terrains_of_every_kind()) {
    const Ground ground(terrain, 5);
    const MeshPlan plan = ground.mesh_plan();
    const Vec2d axis_v{-plan.axis_u.y, plan.axis_u.x};
    Random random(3);
    double tightest = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec2d uv{random.uniform(-20, 120), random.uniform(-20, 120)};
      const Box2d cell{uv, uv + Vec2d{0.3, 0.3}};
      if (std::any_of(plan.u_creases.begin(), plan.u_creases.end(),
                      [&](double u) { return u >= cell.min.x && u <= cell.max.x; }))
        continue;
      const double bound = ground.curvature(cell);
      const auto inside = [&] {
        const double u = random.uniform(cell.min.x, cell.max.x), v = random.uniform(cell.min.y, cell.max.y);
        return u * plan.axis_u + v * axis_v;
      };
      const Vec2d a = inside(), b = inside();
      if (norm(b - a) < 1e-3) continue;
      const Vec2d along = (1 / norm(b - a)) * (b - a);
      const double bend = std::abs(dot(ground.at(b).slope - ground.at(a).slope, along)) / norm(b - a);
      ASSERT_LE(bend, bound * (1 + 1e-9) + 1e-9) << name << " at " << a.x << " " << a.y;
      if (bound > 0) tightest = std::max(tightest, bend / bound);
    }
    if (tightest > 0) {
      EXPECT_GT(tightest, 0.1) << name << ": a bound far from the truth costs time";
    }
  }
}

TEST(Terrain, a_plane_rises_towards_its_azimuth_by_its_angle) {
  const Ground ground(shaped(PlaneTerrain{20, 90, {10, 10}}), 1);
  EXPECT_NEAR(ground.at({10, 55}).z, 0, 1e-12);
  EXPECT_NEAR(ground.at({11, 10}).z, std::tan(20 * std::numbers::pi / 180), 1e-12);
  EXPECT_NEAR(degrees(std::atan(norm(ground.at({3, 4}).slope))), 20, 1e-12);
}

TEST(Terrain, a_ramp_is_level_then_steep_then_level_and_its_breaks_are_as_wide_as_asked) {
  const Ground sharp(shaped(RampTerrain{45, 10, 0, 90, {50, 0}}), 1),
      round(shaped(RampTerrain{45, 10, 2, 90, {50, 0}}), 1);
  EXPECT_NEAR(sharp.at({40, 3}).z, -5, 1e-12);
  EXPECT_NEAR(sharp.at({60, 3}).z, 5, 1e-12);
  EXPECT_NEAR(sharp.at({45.01, 3}).slope.x, 1, 1e-12);
  EXPECT_EQ(sharp.at({44.99, 3}).slope.x, 0);
  EXPECT_EQ(round.at({43.99, 3}).slope.x, 0);
  EXPECT_NEAR(round.at({45, 3}).slope.x, 0.5, 1e-9);  // the middle of the break
  EXPECT_NEAR(round.at({46.01, 3}).slope.x, 1, 1e-12);
  EXPECT_NEAR(round.at({45, 3}).z, -4.75, 1e-9);  // width / 8 x change of slope above the corner
}

TEST(Terrain, steps_and_terraces_have_their_heights_and_face_angles) {
  const Ground step(shaped(StepTerrain{3, 80, 0, {0, 20}}), 1);
  EXPECT_NEAR(step.at({5, 10}).z, -1.5, 1e-12);
  EXPECT_NEAR(step.at({5, 30}).z, 1.5, 1e-12);
  EXPECT_NEAR(degrees(std::atan(step.at({5, 20}).slope.y)), 80, 1e-9);
  const Ground terraces(shaped(TerracesTerrain{3, 2, 8, 70, 90, {0, 0}}), 1);
  const double face = 2 / std::tan(70 * std::numbers::pi / 180);
  EXPECT_EQ(terraces.at({-1, 0}).z, 0);
  EXPECT_NEAR(terraces.at({face + 4, 0}).z, 2, 1e-12);
  EXPECT_NEAR(terraces.at({2 * face + 12, 0}).z, 4, 1e-12);
  EXPECT_NEAR(terraces.at({1000, 0}).z, 6, 1e-12);
}

TEST(Terrain, a_quarry_goes_down_in_benches_to_a_level_floor) {
  const QuarryTerrain shape{{50, 50}, {50, 44}, 30, 3, 4, 3, 75, 0.4};
  const Ground ground(shaped(shape), 1);
  EXPECT_EQ(ground.at({50, 50}).z, -12);
  EXPECT_EQ(ground.at({10, 10}).z, 0);
  double steepest = 0;
  bool on_first_bench = false;
  for (double r = 0; r < 40; r += 0.01) {
    const Ground::Sample here = ground.at({50 + r, 50});
    steepest = std::max(steepest, norm(here.slope));
    on_first_bench = on_first_bench || here.z == -4;
  }
  EXPECT_NEAR(degrees(std::atan(steepest)), 75, 1e-6);
  EXPECT_TRUE(on_first_bench);
}

TEST(Terrain, another_seed_or_roughness_gives_another_fractal_and_each_octave_adds_detail) {
  const auto roughness_of = [](const Terrain& terrain, double step) {
    const Ground ground(terrain, 7);
    double sum = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec2d p{0.37 * i, 11};
      sum += std::pow(ground.at(p + Vec2d{step, 0}).z - 2 * ground.at(p).z + ground.at(p - Vec2d{step, 0}).z, 2);
    }
    return std::sqrt(sum / 2000);
  };
  EXPECT_GT(roughness_of(shaped(FractalTerrain{7, 0.6}, 20, 60), 0.5),
            2 * roughness_of(shaped(FractalTerrain{7, 0.4}, 20, 60), 0.5));
  EXPECT_GT(roughness_of(shaped(FractalTerrain{7, 0.5}, 20, 60), 0.5),
            2 * roughness_of(shaped(FractalTerrain{3, 0.5}, 20, 60), 0.5));
  const Terrain terrain = shaped(FractalTerrain{}, 20, 60);
  EXPECT_NE(Ground(terrain, 1).at({10, 10}).z, Ground(terrain, 2).at({10, 10}).z);
}

TEST(Terrain, the_relief_of_a_fractal_is_used_and_not_exceeded) {
  const Ground ground(shaped(FractalTerrain{7, 0.5}, 20, 40), 3);
  double lowest = 0, highest = 0;
  for (int j = 0; j < 400; ++j)
    for (int i = 0; i < 400; ++i) {
      const double z = ground.at({1. * i, 1. * j}).z;
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
  EXPECT_LE(highest - lowest, 20);
  EXPECT_GT(highest - lowest, 10);
}

TEST(Terrain, a_koch_outline_of_depth_n_has_3_x_4_to_the_n_corners_and_crosses_itself_nowhere) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Vec2d> outline = koch_outline({10, 20}, 30, 3, seed);
    ASSERT_EQ(outline.size(), 192u);
    const auto side = [&](std::size_t i) { return std::pair(outline[i], outline[(i + 1) % outline.size()]); };
    for (std::size_t i = 0; i < outline.size(); ++i)
      for (std::size_t j = i + 2; j < outline.size(); ++j) {
        if (i == 0 && j + 1 == outline.size()) continue;  // neighbours
        const auto [a, b] = side(i);
        const auto [c, d] = side(j);
        // Each side's ends lie on different sides of the other.
        const bool crossing =
            cross(b - a, c - a) * cross(b - a, d - a) < -1e-9 && cross(d - c, a - c) * cross(d - c, b - c) < -1e-9;
        EXPECT_FALSE(crossing) << i << " " << j;
      }
  }
}

TEST(Terrain, the_coast_grows_longer_the_closer_one_looks) {
  const auto length = [](int depth) {
    const std::vector<Vec2d> outline = koch_outline({0, 0}, 30, depth, 4);
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) sum += norm(outline[(i + 1) % outline.size()] - outline[i]);
    return sum;
  };
  EXPECT_GT(length(4), 1.12 * length(3));
  EXPECT_GT(length(5), 1.12 * length(4));
}

TEST(Terrain, the_shore_of_an_island_is_its_outline) {
  const IslandTerrain shape{{50, 50}, 35, 12, 5, 6, 4};
  const Ground ground(shaped(shape), 9);
  EXPECT_GT(ground.at({50, 50}).z, 2);
  EXPECT_NEAR(ground.at({-200, 50}).z, -5, 0.01);
  for (const Vec2d corner : koch_outline(shape.center, shape.radius_m, shape.koch_depth, 9))
    EXPECT_NEAR(ground.at(corner).z, 0, 0.3);  // rounded by the lattice of 0.35 m, on slopes of up to 1/2
}

TEST(Terrain, signed_distances_are_those_of_a_square) {
  const std::vector<Vec2d> square = {{2, 2}, {8, 2}, {8, 8}, {2, 8}};
  const Array2d<double> distance = signed_distances(square, {0.05, 0.05}, 0.1, 100, 100);
  EXPECT_NEAR(distance(50, 50), 8 - 5.05, 1e-12);
  EXPECT_NEAR(distance(50, 10), -(2 - 1.05), 1e-12);
  EXPECT_NEAR(distance(0, 0), -std::hypot(1.95, 1.95), 1e-12);
}

TEST(Terrain, a_height_grid_passes_through_its_heights_and_joins_a_parabola_exactly) {
  Array2d<double> heights(9, 7);
  const auto z = [](double x, double y) { return 1 + 0.5 * x - 0.25 * y + 0.1 * x * x - 0.05 * x * y; };
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 9; ++i) heights(i, j) = z(3 + 2. * i, -1 + 0.5 * j);
  const HeightGrid grid(heights, {3, -1}, {2, 0.5}, HeightGrid::Beyond::border);
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(grid.at({3 + 2. * i, -1 + 0.5 * j}).z, heights(i, j), 1e-12);
  // Away from the border Catmull-Rom reproduces polynomials of second degree.
  EXPECT_NEAR(grid.at({9.3, 0.7}).z, z(9.3, 0.7), 1e-12);
  EXPECT_NEAR(grid.at({9.3, 0.7}).slope.x, 0.5 + 0.2 * 9.3 - 0.05 * 0.7, 1e-12);
  EXPECT_NEAR(grid.at({-500, 0.5}).z, grid.at({-50, 0.5}).z, 1e-12);  // beyond: the border goes on
  EXPECT_EQ(grid.at({-500, 0.5}).slope.x, 0);
}

TEST(Terrain, a_crater_is_a_bell_on_the_ground_and_ends_with_its_rectangle) {
  Terrain terrain;
  terrain.modifications = {crater({20, 30}, {16, 16}, 2)};
  const Ground ground(terrain, 1);
  EXPECT_NEAR(ground.at({20, 30}).z, -2, 1e-12);
  EXPECT_NEAR(ground.at({22, 30}).z, -2 * std::exp(-0.5), 1e-12);  // r = 1: a quarter of half the side
  EXPECT_NEAR(ground.at({24, 32}).z, -2 * std::exp(-2.5), 1e-12);
  EXPECT_EQ(ground.at({20, 60}).z, 0);
  EXPECT_NEAR(ground.at({32.5, 30}).z, 0, 1e-9);
}

TEST(Terrain, a_matrix_lies_with_its_first_row_in_the_north) {
  Terrain terrain;
  terrain.modifications = {{{10, 10}, {4, 2}, 3, 2, {1, 2, 3, 4, 5, 6}}};
  const Ground ground(terrain, 1);
  EXPECT_NEAR(ground.at({8, 11}).z, 1, 1e-12);
  EXPECT_NEAR(ground.at({12, 11}).z, 3, 1e-12);
  EXPECT_NEAR(ground.at({10, 9}).z, 5, 1e-12);
}

TEST(Terrain, mesh_lines_pass_through_creases_and_are_fine_where_asked) {
  const std::vector<double> lines = mesh_lines(0, 10, 4, {3.3, 20}, {{6, 7, 0.25}});
  EXPECT_EQ(lines.front(), 0);
  EXPECT_EQ(lines.back(), 10);
  EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end()));
  EXPECT_NE(std::find(lines.begin(), lines.end(), 3.3), lines.end());
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](double v) { return v >= 6 && v <= 7; }), 5);
  EXPECT_LT(lines.size(), 12u);
}

}  // namespace
}  // namespace skysweep::scene
