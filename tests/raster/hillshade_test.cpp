// SPDX-License-Identifier: Apache-2.0
#include "raster/hillshade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace skysweep::raster {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

// Heights by place; `cells` squared.
template <typename Height>
Raster<float> surface(int cells, double cell_m, Height height) {
  Raster<float> dem{Array2d<float>(cells, cells), {"", {0, cells * cell_m}, cell_m}, {}};
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column)
      dem.values(column, row) = static_cast<float>(height(dem.georeference.cell_center(column, row)));
  return dem;
}

Raster<float> plane(double east, double north) {
  return surface(9, 0.5, [=](Vec2d p) { return 30 + east * p.x + north * p.y; });
}

Array2d<Rgb8> relief(const Raster<float>& dem) {
  std::vector<float> heights;
  std::copy_if(dem.values.begin(), dem.values.end(), std::back_inserter(heights),
               [](float z) { return std::isfinite(z); });
  return shaded_relief(dem, usual_span(heights));
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
  auto dem = surface(100, 1, [](Vec2d p) { return p.x / 100; });
  const Array2d<Rgb8> before = relief(dem);
  for (int i = 0; i < 9; ++i) dem.values(50, 10 + i * 8) = 1e6f;
  const Array2d<Rgb8> after = relief(dem);
  EXPECT_NEAR(after(20, 50).g, before(20, 50).g, 2);
  EXPECT_NE(before(5, 50), before(95, 50));
}

TEST(ShadedRelief, of_a_surface_without_any_height_is_a_checkerboard) {
  const auto dem = surface(20, 1, [](Vec2d) { return kHole; });
  EXPECT_GE(relief(dem)(3, 3).r, 220);
}

}  // namespace
}  // namespace skysweep::raster
