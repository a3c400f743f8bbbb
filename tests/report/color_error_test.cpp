// SPDX-License-Identifier: Apache-2.0
#include "report/color_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "rasters.h"

namespace skysweep::report {
namespace {

raster::Raster<Rgba8> plain(Rgba8 color, int width = 20, int height = 5) {
  return make_raster<Rgba8>(width, height, at({0, static_cast<double>(height)}, 1), [=](Vec2d) { return color; });
}

TEST(ColorError, a_tint_shows_with_its_sign_in_its_channel) {
  const ColorError e = color_error(plain({110, 93, 200, 255}), plain({100, 100, 200, 255}));
  EXPECT_EQ(e.cells, 100);
  EXPECT_EQ(e.true_cells, 100);
  EXPECT_EQ(e.channels[0].median, 10);
  EXPECT_EQ(e.channels[1].median, -7);
  EXPECT_EQ(e.channels[1].median_absolute, 7);
  EXPECT_EQ(e.channels[2].median, 0);
  EXPECT_EQ(e.channels[2].p95_absolute, 0);
}

TEST(ColorError, extremes_are_held) {
  EXPECT_EQ(color_error(plain({255, 0, 0, 255}), plain({0, 255, 0, 255})).channels[0].median, 255);
  EXPECT_EQ(color_error(plain({255, 0, 0, 255}), plain({0, 255, 0, 255})).channels[1].median, -255);
}

TEST(ColorError, the_tail_is_in_the_quantile) {
  auto ortho = plain({50, 50, 50, 255});
  for (int i = 0; i < 6; ++i) ortho.values(i, 0).r = 90;  // six of a hundred
  const ColorError e = color_error(ortho, plain({50, 50, 50, 255}));
  EXPECT_EQ(e.channels[0].median_absolute, 0);
  EXPECT_EQ(e.channels[0].p95_absolute, 40);
  EXPECT_EQ(e.channels[1].p95_absolute, 0);
}

TEST(ColorError, transparent_cells_are_left_out_on_either_side) {
  auto ortho = plain({60, 50, 50, 255}), truth = plain({50, 50, 50, 255});
  ortho.values(0, 0) = {255, 255, 255, 0};
  truth.values(1, 0) = {255, 255, 255, 0};
  const ColorError e = color_error(ortho, truth);
  EXPECT_EQ(e.true_cells, 99);
  EXPECT_EQ(e.cells, 98);
  EXPECT_EQ(e.channels[0].p95_absolute, 10);
}

TEST(ColorError, cells_are_compared_where_they_lie) {
  // The orthophoto begins three cells further east and holds its column number.
  const auto truth = make_raster<Rgba8>(10, 4, at({0, 4}, 1), [](Vec2d p) {
    return Rgba8{static_cast<std::uint8_t>(10 * p.x), 0, 0, 255};
  });
  const auto ortho = make_raster<Rgba8>(10, 4, at({3, 4}, 1), [](Vec2d p) {
    return Rgba8{static_cast<std::uint8_t>(10 * p.x), 0, 0, 255};
  });
  const ColorError e = color_error(ortho, truth);
  EXPECT_EQ(e.cells, 28);
  EXPECT_EQ(e.channels[0].p95_absolute, 0);
}

TEST(ColorError, without_common_colours_there_is_no_number) {
  const ColorError e = color_error(plain({0, 0, 0, 0}), plain({1, 1, 1, 255}));
  EXPECT_EQ(e.cells, 0);
  for (const ChannelError& channel : e.channels) {
    EXPECT_TRUE(std::isnan(channel.median));
    EXPECT_TRUE(std::isnan(channel.median_absolute));
  }
}

TEST(ColorError, other_grids_are_refused) {
  const auto shifted = make_raster<Rgba8>(4, 4, at({0.5, 4}, 1), [](Vec2d) { return Rgba8{}; });
  EXPECT_THROW(color_error(shifted, plain({})), Error);
}

}  // namespace
}  // namespace skysweep::report
