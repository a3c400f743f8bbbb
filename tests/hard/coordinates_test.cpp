// SPDX-License-Identifier: Apache-2.0
// Hard cases of coordinates: large, negative, around zero. (Whole flights there: flights_test.cpp; bit for bit:
// tests/laws/translation_law_test.cpp.)
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipeline/coverage.h"
#include "pipeline/lattice_limits.h"
#include "tiles/lattice.h"

namespace skysweep::hard {
namespace {

// Hard: truncation instead of floor gives the tiles on both sides of zero one index; -0 and denormal numbers lie
// between. Bound: each position belongs to exactly the tile whose corners enclose it.
TEST(HardCoordinates, tiles_that_meet_in_the_origin) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  const tiles::Lattice lattice{64, 0.1, 0.1};
  EXPECT_EQ(lattice.index_at(0, 0.0), 0);
  EXPECT_EQ(lattice.index_at(0, -0.0), 0);
  EXPECT_EQ(lattice.index_at(0, kTiny), 0);
  EXPECT_EQ(lattice.index_at(0, -kTiny), -1);
  for (const double x : {-12.8, -6.4, -6.3999999999, -1e-9, 1e-9, 6.4, 12.8}) {
    const tiles::TileKey key = lattice.key_at(0, {x, -x});
    const Box2d box = lattice.extent(key);
    EXPECT_TRUE(x >= box.min.x && x < box.max.x && -x >= box.min.y && -x < box.max.y) << x;
  }
  EXPECT_EQ((tiles::TileKey{0, -1, -1}.parent()), (tiles::TileKey{1, -1, -1}));
}

// Hard: a quotient of two large numbers is rounded across the border of a tile. Bound: as above, a million tiles out.
TEST(HardCoordinates, borders_of_tiles_at_ten_million_metres) {
  const tiles::Lattice lattice{512, 0.1, 0.1};
  for (int k = 195000; k < 195400; ++k) {
    for (const int index : {k, -k}) {
      const double border = lattice.south_west_corner({0, index, 0}).x;
      EXPECT_EQ(lattice.index_at(0, border), index);
      EXPECT_EQ(lattice.index_at(0, std::nextafter(border, -HUGE_VAL)), index - 1);
    }
  }
}

// Hard: a ground point and a camera 10^7 m from the origin leave nine digits for what lies between them.
// Bound: in the tile's frame the pixel is that of the same scene at the origin to 10^-9 pixels.
TEST(HardCoordinates, pixels_do_not_depend_on_where_the_scene_lies) {
  const camera::CameraModel model{4000, 3000, 3600, 3600, 2000, 1500, {}};
  const Mat3d rotation = camera::rotation_from_yaw_pitch_roll(31, -88, 2);
  const Vec3d center = camera::snap_position({3.21, -4.56, 101.7});
  const camera::Camera here(model, {rotation, center});
  for (const Vec3d origin : {Vec3d{691200, 5334016, 0}, {-1e7, 1e7, 0}, {-0.5, -0.25, 0}}) {
    const camera::Camera there = camera::Camera(model, {rotation, center + origin}).relative_to(origin);
    const auto a = here.project({1, 2, 3}), b = there.project({1, 2, 3});
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->x, b->x, 1e-9);
    EXPECT_NEAR(a->y, b->y, 1e-9);
  }
}

index::ImageRecord photograph_at(const std::string& name, Vec3d center) {
  index::ImageRecord record;
  record.name = name;
  record.model = {320, 240, 300, 300, 160, 120, {}};
  record.pose = {camera::rotation_from_yaw_pitch_roll(0, -90, 0), center};
  return record;
}

pipeline::ProjectSettings settings_for(double depth_m, double cell_m) {
  pipeline::ProjectSettings settings;
  settings.lattice = {64, cell_m, cell_m};
  settings.configuration.tiles.cells = 64;
  settings.search = {depth_m, 1.15 * depth_m, 0.5 * depth_m, 1.15 * depth_m, std::nullopt};
  return settings;
}

// Hard: two sites a hemisphere apart: 10^12 tiles lie between them. Bound: those of the two sites alone are visited.
TEST(HardCoordinates, tiles_between_two_far_sites_are_never_visited) {
  std::vector<index::ImageRecord> records;
  for (int i = 0; i < 3; ++i) records.push_back(photograph_at("a" + std::to_string(i), {3.0 * i, 0, 30}));
  const pipeline::ProjectSettings settings = settings_for(30, 0.1);
  const auto near_ones = pipeline::Coverage(records, settings).tiles(std::nullopt);
  for (int i = 0; i < 3; ++i) records.push_back(photograph_at("b" + std::to_string(i), {9e6 + 3.0 * i, -9e6, 30}));
  const auto both = pipeline::Coverage(records, settings).tiles(std::nullopt);
  EXPECT_GE(near_ones.size(), 20u);
  EXPECT_GE(both.size(), 2 * near_ones.size() - 20);
  EXPECT_LE(both.size(), 2 * near_ones.size() + 20);
  ASSERT_EQ(pipeline::scatter_warnings(records).size(), 1u);
  EXPECT_NE(pipeline::scatter_warnings(records)[0].find("3 of 6 photographs"), std::string::npos)
      << pipeline::scatter_warnings(records)[0];
}

// Hard: a scene of one millimetre: the grid of 2^-20 m to which positions are snapped is a third of its pixels.
// Bound: the run says so; a scene of a metre is left in peace.
TEST(HardCoordinates, a_microscope_is_told_to_what_positions_are_rounded) {
  const std::vector<index::ImageRecord> records = {photograph_at("a", {0, 0, 1e-3}),
                                                   photograph_at("b", {2e-4, 0, 1e-3})};
  const auto warnings = pipeline::resolution_warnings(records, settings_for(1e-3, 3e-6));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("camera positions are rounded"), std::string::npos) << warnings[0];
  EXPECT_TRUE(pipeline::resolution_warnings(records, settings_for(1, 1e-3)).empty());
  EXPECT_TRUE(pipeline::scatter_warnings(records).empty());
}

}  // namespace
}  // namespace skysweep::hard
