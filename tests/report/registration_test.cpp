// SPDX-License-Identifier: Apache-2.0
#include "report/registration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "rasters.h"

namespace skysweep::report {
namespace {

// Band-limited texture: sums of waves in many directions, shorter ones down to seven cells.
double wave_sum(Vec2d p) {
  double sum = 0;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.39996 * i, wavelength = 7 + 1.3 * i;
    sum += std::sin(6.2831853 * (p.x * std::cos(angle) + p.y * std::sin(angle)) / wavelength + 5 * i);
  }
  return 128 + 12 * sum;
}

raster::Raster<Rgba8> textured(Vec2d content_shift, int width = 256, int height = 192) {
  return make_raster<Rgba8>(width, height, at({0, static_cast<double>(height)}, 1), [&](Vec2d p) {
    const auto grey = static_cast<std::uint8_t>(std::min(255.0, std::max(0.0, wave_sum(p - content_shift) + 0.5)));
    return Rgba8{grey, grey, grey, 255};
  });
}

TEST(Registration, identical_orthophotos_are_not_shifted_and_do_not_differ) {
  const auto truth = textured({0, 0});
  const Registration r = compare_orthophotos(truth, truth);
  EXPECT_EQ(r.blocks, 12);
  EXPECT_EQ(r.blocks_used, 2);  // of 4 x 3 blocks only two have room to search on all sides
  EXPECT_NEAR(r.median_shift_cells, 0, 0.01);
  EXPECT_EQ(r.mean_color_difference, 0);
}

TEST(Registration, sub_cell_shifts_are_found_with_their_direction) {
  const auto truth = textured({0, 0});
  for (const Vec2d shift : {Vec2d{0.5, 0}, Vec2d{-0.3, 0.25}, Vec2d{1.75, -1.2}}) {
    const Registration r = compare_orthophotos(textured(shift), truth);
    EXPECT_GT(r.blocks_used, 0);
    EXPECT_NEAR(r.median_shift_x_cells, shift.x, 0.05);
    EXPECT_NEAR(r.median_shift_y_cells, shift.y, 0.05);
    EXPECT_NEAR(r.median_shift_cells, norm(shift), 0.05);
  }
}

TEST(Registration, blocks_without_texture_are_not_used_and_a_hole_costs_none) {
  auto truth = textured({0, 0}, 256, 256);
  auto ortho = truth;
  EXPECT_EQ(compare_orthophotos(ortho, truth).blocks_used, 4);
  ortho.values(80, 80).a = 0;
  EXPECT_EQ(compare_orthophotos(ortho, truth).blocks_used, 4);
  EXPECT_NEAR(compare_orthophotos(ortho, truth).median_shift_cells, 0, 0.01);
  for (int y = 128; y < 192; ++y)
    for (int x = 128; x < 192; ++x) truth.values(x, y) = {90, 90, 90, 255};
  EXPECT_EQ(compare_orthophotos(ortho, truth).blocks_used, 3);
}

TEST(Registration, a_shift_beyond_the_search_is_not_invented) {
  EXPECT_EQ(compare_orthophotos(textured({9, 0}), textured({0, 0})).blocks_used, 0);
}

TEST(Registration, a_larger_orthophoto_on_the_same_lattice_is_compared_where_both_lie) {
  const auto truth = textured({0, 0});
  const auto ortho = make_raster<Rgba8>(300, 220, at({-20, 202}, 1), [](Vec2d p) {
    const auto grey = static_cast<std::uint8_t>(std::min(255.0, std::max(0.0, wave_sum(p) + 0.5)));
    return Rgba8{grey, static_cast<std::uint8_t>(grey / 2), grey, 255};
  });
  const Registration r = compare_orthophotos(ortho, truth);
  EXPECT_EQ(r.blocks_used, 12);
  EXPECT_NEAR(r.median_shift_cells, 0, 0.02);
  EXPECT_NEAR(r.mean_color_difference, 128. / 6, 2);
}

TEST(Registration, other_grids_are_refused) {
  const auto truth = textured({0, 0});
  auto moved = truth;
  moved.georeference.north_west_corner.x += 0.5;
  EXPECT_THROW(compare_orthophotos(moved, truth), Error);
}

}  // namespace
}  // namespace skysweep::report
