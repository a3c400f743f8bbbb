// SPDX-License-Identifier: Apache-2.0
#include "report/hillshade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rasters.h"

namespace skysweep::report {
namespace {

raster::Raster<float> plane(double east, double north) {
  return make_raster<float>(9, 9, at({0, 4.5}, 0.5), [=](Vec2d p) { return 30 + east * p.x + north * p.y; });
}

TEST(Hillshade, level_ground_has_the_sine_of_the_elevation) {
  EXPECT_EQ(hillshade(plane(0, 0))(4, 4).r, std::lround(255 * std::sin(std::numbers::pi / 4)));
}

TEST(Hillshade, a_slope_that_faces_the_sun_is_white_and_the_opposite_one_black) {
  const double fall = std::sqrt(0.5);                                     // 45 degrees along the diagonal
  EXPECT_EQ(hillshade(plane(fall, -fall))(4, 4), (Rgb8{255, 255, 255}));  // falls to the north-west
  EXPECT_EQ(hillshade(plane(-fall, fall))(4, 4), (Rgb8{0, 0, 0}));
}

TEST(Hillshade, cells_without_height_are_light_grey_and_do_not_touch_their_neighbours) {
  auto dem = plane(0, 0);
  dem.values(4, 4) = kHole;
  const Array2d<Rgb8> image = hillshade(dem);
  EXPECT_GE(image(4, 4).r, 220);
  EXPECT_EQ(image(5, 4), image(0, 0));
}

TEST(ShadedRelief, colours_ignore_a_few_outliers) {
  auto dem = make_raster<float>(100, 100, at({0, 100}, 1), [](Vec2d p) { return p.x / 100; });
  const Array2d<Rgb8> before = shaded_relief(dem);
  for (int i = 0; i < 9; ++i) dem.values(50, 10 + i * 8) = 1e6f;
  const Array2d<Rgb8> after = shaded_relief(dem);
  EXPECT_NEAR(after(20, 50).g, before(20, 50).g, 2);
  EXPECT_NE(before(5, 50), before(95, 50));
}

TEST(ShadedRelief, of_a_surface_without_any_height_is_a_checkerboard) {
  const auto dem = make_raster<float>(20, 20, at({0, 20}, 1), [](Vec2d) { return kHole; });
  EXPECT_GE(shaded_relief(dem)(3, 3).r, 220);
}

}  // namespace
}  // namespace skysweep::report
