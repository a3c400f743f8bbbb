// SPDX-License-Identifier: Apache-2.0
// The mirror image and the sun's glitter on water.
#include "scene/effects/specular_water.h"

#include <numbers>

#include "scene/effects/small_flight.h"

namespace skysweep::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Deep water everywhere, of one colour; the sun in the south.
std::string lake(double sun_elevation_deg, const std::string& more = "") {
  return "[terrain]\nkind = \"plane\"\nslope_deg = 1\nwater_level_m = 20\n[texture]\ncontrast = 0\n[light]\n"
         "sun_azimuth_deg = 180\nsun_elevation_deg = " +
         std::to_string(sun_elevation_deg) + "\n" + more;
}
std::string wind(double mps) { return "[effects.specular_water]\nwind_mps = " + std::to_string(mps) + "\n"; }

// 20 m of water above z = 0: the flight is raised with it.
std::vector<camera::Pose> over_the_lake() {
  std::vector<camera::Pose> poses = north_and_back();
  for (camera::Pose& pose : poses) pose.center.z += 20;
  return poses;
}

Array2d<LinearRgb> light_of_lake(const std::string& text, std::size_t photograph = 0) {
  const SmallFlight flight(level_scene(text), over_the_lake());
  SerialExecutor executor;
  const auto changes = flight.effects ? flight.effects->photograph(photograph, flight.world) : nullptr;
  return take_linear_photograph(flight.world, flight.scene.camera, PixelRays(flight.scene.camera),
                                flight.poses[photograph], {}, executor, changes.get());
}

// Green light, mean of a square of `side` pixels around a pixel.
double green_around(const Array2d<LinearRgb>& photo, int column, int row, int side) {
  double sum = 0;
  for (int r = row - side / 2; r <= row + side / 2; ++r)
    for (int c = column - side / 2; c <= column + side / 2; ++c) sum += photo(c, r).g;
  return sum / (side * side);
}

TEST(WaterReflectance, is_that_of_fresnel) {
  EXPECT_NEAR(water_reflectance(1), std::pow(0.333 / 2.333, 2), 1e-12);
  EXPECT_NEAR(water_reflectance(0), 1, 1e-12);
  // At Brewster's angle tan a = n only the light that swings across the plane of incidence comes back.
  const double n = 1.333, brewster = std::atan(n);
  EXPECT_NEAR(water_reflectance(std::cos(brewster)), 0.5 * std::pow((n * n - 1) / (n * n + 1), 2), 1e-12);
}

// All the sun's light that a rough surface throws back, summed over the directions of view, is what its facets reflect.
TEST(SunGlitter, holds_the_light_that_the_facets_throw_back) {
  for (const double elevation : {40., 60., 90.}) {
    const Vec3d to_sun{0, -std::cos(elevation * kDegree), std::sin(elevation * kDegree)};
    const double variance = mean_square_slope(1);
    double sum = 0;
    constexpr int kZeniths = 720, kAzimuths = 720;
    for (int i = 0; i < kZeniths; ++i)
      for (int k = 0; k < kAzimuths; ++k) {
        const double zenith = (i + 0.5) * 90 * kDegree / kZeniths, azimuth = (k + 0.5) * 360 * kDegree / kAzimuths;
        const Vec3d to_camera{std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
                              std::cos(zenith)};
        const double solid_angle = std::sin(zenith) * (90 * kDegree / kZeniths) * (360 * kDegree / kAzimuths);
        sum += sun_glitter(to_camera, to_sun, {}, variance) * to_camera.z * solid_angle;
      }
    // Light of a white surface that faces the sun is its irradiance / pi. The mean reflectance of tilted facets is a
    // little above that of level water.
    const double expected = std::numbers::pi * to_sun.z * water_reflectance(to_sun.z);
    EXPECT_NEAR(sum / expected, 1, 0.03) << elevation;
  }
}

TEST(WaterWaves, slopes_are_those_of_cox_and_munk_at_every_gsd) {
  EXPECT_DOUBLE_EQ(mean_square_slope(0), 0.003);
  EXPECT_DOUBLE_EQ(mean_square_slope(10), 0.0542);
  double coarser = 1;
  for (const double gsd : {0.01, 0.1, 0.4, 2.}) {
    const WaterWaves waves(6, 270, gsd, 5);
    EXPECT_DOUBLE_EQ(waves.seen_variance() + waves.fine_variance(), mean_square_slope(6));
    EXPECT_GE(waves.fine_variance(), 0.003);
    Vec2d sum;
    double squares = 0;
    constexpr int kSide = 200;
    for (int i = 0; i < kSide; ++i)
      for (int k = 0; k < kSide; ++k) {
        const Vec2d s = waves.slope({1.37 * i, 1.91 * k}, 0);
        sum = sum + s;
        squares += dot(s, s);
      }
    constexpr double kPlaces = kSide * kSide;
    if (gsd == 2) {
      EXPECT_EQ(squares, 0);
      continue;
    }
    EXPECT_NEAR(squares / kPlaces / waves.seen_variance(), 1, 0.03) << gsd;
    EXPECT_LT(norm((1 / kPlaces) * sum), 0.03 * std::sqrt(waves.seen_variance())) << gsd;
    EXPECT_LT(waves.seen_variance(), coarser);
    coarser = waves.seen_variance();
  }
  EXPECT_EQ(WaterWaves(0, 270, 0.01, 5).seen_variance(), 0);
}

TEST(WaterWaves, travel_with_the_wind) {
  // From the west: the pattern a moment later is found to the east of where it was, not to the west.
  const WaterWaves waves(6, 270, 0.1, 5);
  const auto difference = [&](double moved_m) {
    double sum = 0;
    for (int i = 0; i < 60; ++i)
      for (int k = 0; k < 60; ++k) {
        const Vec2d p{0.7 * i, 0.9 * k};
        const Vec2d d = waves.slope({p.x + moved_m, p.y}, 0.05) - waves.slope(p, 0);
        sum += dot(d, d);
      }
    return sum;
  };
  EXPECT_LT(difference(0.05), difference(0));
  EXPECT_LT(difference(0), difference(-0.05));
}

// The camera looks straight down from 6 m with 60 pixels of focal length: the sun at 20 degrees from the zenith is
// mirrored 60 tan 20 = 21.8 pixels below the middle of the picture, wherever the camera is.
TEST(SpecularWater, the_sun_glitters_where_the_water_mirrors_it_and_goes_with_the_camera) {
  const std::string text = lake(70, wind(0));
  const Array2d<LinearRgb> south = light_of_lake(text, 0), north = light_of_lake(text, 1);
  int column = 0, row = 0;
  for (int r = 0; r < 48; ++r)
    for (int c = 0; c < 64; ++c)
      if (south(c, r).g > south(column, row).g) column = c, row = r;
  EXPECT_NEAR(column + 0.5, 32, 1.1);
  EXPECT_NEAR(row + 0.5, 24 + 60 * std::tan(20 * kDegree), 1.5);
  EXPECT_GT(south(column, row).g, 5 * light_of_lake(lake(70))(column, row).g);
  // The second photograph is taken eight pixels further north: the same pixel glitters, which is another place.
  EXPECT_NEAR(north(column, row).g, south(column, row).g, 0.02 * south(column, row).g);
  EXPECT_LT(south(column, row - 8).g, 0.5 * north(column, row).g);
}

TEST(SpecularWater, wind_spreads_the_glitter) {
  double at_its_middle = 1e9, aside = 0;
  for (const double mps : {0., 2., 8.}) {
    const Array2d<LinearRgb> photo = light_of_lake(lake(80, wind(mps)));
    const double bright = green_around(photo, 32, 24 + 10, 9), away = green_around(photo, 32, 5, 9);
    EXPECT_LT(bright, at_its_middle) << mps;
    EXPECT_GT(away, aside) << mps;
    at_its_middle = bright;
    aside = away;
  }
}

TEST(SpecularWater, waves_go_on_from_photograph_to_photograph) {
  const std::string text = lake(80, wind(3));
  const Array2d<LinearRgb> first = light_of_lake(text, 0), third = light_of_lake(text, 2);
  int differing = 0;
  for (std::size_t i = 0; i < first.size(); ++i) differing += std::abs(first.data()[i].g - third.data()[i].g) > 0.02;
  EXPECT_GT(differing, 200);
  EXPECT_NE(light_of_lake(lake(80, wind(3) + "wind_from_deg = 90\n"))(32, 34).g, first(32, 34).g);
}

TEST(SpecularWater, no_sun_glitters_in_a_shadow) {
  const std::string block = "[[building]]\ncenter = [3.2, -0.6]\nsize_m = [3, 1]\nroof_z_m = 23\n";
  const float dark = light_of_lake(lake(70, "shadows = false\n" + block))(32, 45).g;
  EXPECT_GT(light_of_lake(lake(70, "shadows = false\n" + block + wind(0)))(32, 45).g, 5 * dark);
  EXPECT_LT(light_of_lake(lake(70, block + wind(0)))(32, 45).g, dark);
}

TEST(SpecularWater, shows_the_mirror_image_of_the_sky_and_of_what_stands_at_the_shore) {
  const std::string block = "[[building]]\ncenter = [3.2, 15]\nsize_m = [9, 4]\nroof_z_m = 26\n";
  for (const bool built : {false, true}) {
    const SmallFlight flight(level_scene(lake(70, (built ? block : "") + wind(0))), over_the_lake());
    const SpecularWaterEffect effect(*flight.scene.effects.specular_water, flight.scene, {});
    const Ray ray{{3.2, 2.4, 20.5}, {0, 1, -0.1}}, mirrored{{3.2, 7.4, 20.01}, {0, 1, 0.1}};
    SurfacePoint hit, seen;
    LinearRgb water, image, light;
    flight.world.look(&ray, 1, &hit, &water);
    flight.world.look(&mirrored, 1, &seen, &image);
    ASSERT_EQ(hit.face, Face::water);
    ASSERT_EQ(seen.face == Face::wall, built);
    if (!built) image = flight.world.moment().sky;
    light = water;
    effect.shine({}, flight.world, flight.world.moment(), &ray, &hit, 1, &light);
    const auto reflected = static_cast<float>(water_reflectance(0.1 / std::sqrt(1.01)));
    EXPECT_GT(reflected, 0.5);
    EXPECT_NEAR(light.r, (1 - reflected) * water.r + reflected * image.r, 1e-6);
    EXPECT_NEAR(light.b, (1 - reflected) * water.b + reflected * image.b, 1e-6);
  }
}

TEST(SpecularWater, needs_water_and_a_wind_that_was_measured) {
  EXPECT_TRUE(refused(wind(3), "needs water"));
  EXPECT_TRUE(refused(lake(70, "[effects.specular_water]\n"), "set its wind_mps"));
  EXPECT_TRUE(refused(lake(70, wind(-1)), "between 0 and 14"));
  EXPECT_TRUE(refused(lake(70, wind(20)), "between 0 and 14"));
  EXPECT_TRUE(refused(lake(70, wind(3) + "wind_from_deg = 400\n"), "between -360 and 360"));
}

}  // namespace
}  // namespace skysweep::scene
