// SPDX-License-Identifier: Apache-2.0
// Effects of light: sky, the sun's movement, shadows of clouds, moving cars.
#include <numbers>

#include "scene/effects/cloud_shadows.h"
#include "scene/effects/moving_cars.h"
#include "scene/effects/small_flight.h"
#include "scene/effects/sun_movement.h"

namespace skysweep::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Sun in the south at 45 degrees; a block 1.5 m high throws its shadow north, over the pixel (32, 16).
const std::string kBlock =
    "[texture]\ncontrast = 0\n[light]\nsun_azimuth_deg = 180\nsun_elevation_deg = 45\n[[building]]\n"
    "center = [3.2, 1.4]\nsize_m = [2, 2]\nroof_z_m = 1.5\n";

TEST(Sky, lights_the_shadows) {
  const Rgb8 plain = picture_of(kBlock)(32, 16);
  const Rgb8 dark = picture_of(kBlock + "[effects.sky]\nstrength = 0\n")(32, 16);
  const Rgb8 bright = picture_of(kBlock + "[effects.sky]\nstrength = 2\n")(32, 16);
  const Rgb8 red = picture_of(kBlock + "[effects.sky]\ncolor = [1.5, 1, 0]\n")(32, 16);
  EXPECT_EQ(dark, (Rgb8{0, 0, 0}));
  EXPECT_NEAR(light_of(bright.g) / light_of(plain.g), 2, 0.06);
  EXPECT_NEAR(light_of(red.r) / light_of(plain.r), 1.5, 0.05);
  EXPECT_EQ(red.g, plain.g);
  EXPECT_EQ(red.b, 0);
}

TEST(Sky, belongs_to_the_truth_too_and_no_change_is_refused) {
  const SmallFlight plain(level_scene(kBlock)), flight(level_scene(kBlock + "[effects.sky]\nstrength = 2\n"));
  EXPECT_FLOAT_EQ(flight.world.moment().sky.g, 2 * plain.world.moment().sky.g);
  EXPECT_TRUE(refused("[effects.sky]\n", "strength or color other than 1"));
  EXPECT_TRUE(refused("[effects.sky]\nstrength = -1\n", "between 0 and 100"));
}

TEST(SunMovement, turns_the_sun_about_the_pole_by_15_degrees_an_hour) {
  const Vec3d noon{0, -std::cos(45 * kDegree), std::sin(45 * kDegree)};  // equinox at 45 degrees north
  const Vec3d evening = sun_after(noon, 6, 45), morning = sun_after(noon, -6, 45);
  EXPECT_NEAR(norm(evening - Vec3d{-1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(morning - Vec3d{1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(std::acos(dot(noon, sun_after(noon, 2, 45))), 30 * kDegree, 1e-12);
}

TEST(SunMovement, shadows_go_from_west_to_east_and_the_truth_keeps_its_light) {
  const SmallFlight flight(level_scene(kBlock + "[effects.sun_movement]\nhours = 6\n"));
  const Array2d<Rgb8> morning = flight.photograph(0), evening = flight.photograph(2);
  EXPECT_LT(light_of(morning(14, 16).r), 0.5 * light_of(evening(14, 16).r));
  EXPECT_LT(light_of(evening(50, 16).r), 0.5 * light_of(morning(50, 16).r));
  EXPECT_NEAR(norm(flight.world.moment().towards_sun - Vec3d{0, -std::sqrt(0.5), std::sqrt(0.5)}), 0, 1e-12);
  EXPECT_TRUE(refused(kBlock + "[effects.sun_movement]\nhours = 0\n", "leave the table out"));
  EXPECT_TRUE(refused(kBlock + "[effects.sun_movement]\nhours = 14\n", "below 2 degrees"));
  EXPECT_TRUE(refused(kBlock + "[effects.sun_movement]\nhours = 1\nlatitude_deg = 91\n", "between -90 and 90"));
}

TEST(CloudShadows, cover_the_share_asked_for) {
  for (const double cover : {0.2, 0.5, 0.8}) {
    CloudShadows settings;
    settings.cover = cover;
    const CloudShadowsEffect clouds(settings, {}, {});
    int dark = 0;
    for (int y = 0; y < 150; ++y)
      for (int x = 0; x < 150; ++x) {
        const double taken = clouds.taken_at({60.0 * x, 60.0 * y});
        EXPECT_GE(taken, 0);
        EXPECT_LE(taken, settings.density);
        dark += taken > 0.5 * settings.density;
      }
    EXPECT_NEAR(dark / 22500.0, cover, 0.03);
  }
}

TEST(CloudShadows, travel_with_the_wind_and_are_not_in_the_truth) {
  const std::string flat = "[texture]\ncontrast = 0\n";
  // 10 m/s from the west for the 0.2 s between the first and the third photograph: 20 columns.
  const SmallFlight flight(level_scene(
      flat + "[effects.cloud_shadows]\ncover = 0.5\ndensity = 1\nsize_m = 0.8\nwind_mps = 10\nwind_from_deg = 270\n"));
  const Array2d<Rgb8> first = flight.photograph(0), third = flight.photograph(2);
  const Array2d<Rgb8> sunny = picture_of(flat);
  const auto left = [&](const Array2d<Rgb8>& photo, int x, int y) {
    return light_of(photo(x, y).g) / light_of(sunny(x, y).g);
  };
  int differing = 0, dark = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x + 20 < 64; ++x) {
      EXPECT_NEAR(left(third, x + 20, y), left(first, x, y), 0.06) << x << " " << y;
      differing += std::abs(left(first, x, y) - left(third, x, y)) > 0.1;
      dark += left(first, x, y) < 0.6;
    }
  EXPECT_GT(differing, 300);
  EXPECT_GT(dark, 200);
  EXPECT_FALSE(flight.world.moment().clouds);
  EXPECT_TRUE(refused("[effects.cloud_shadows]\ncover = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.cloud_shadows]\ncover = 1.5\n", "at most 1"));
  EXPECT_TRUE(refused("[effects.cloud_shadows]\ncover = 0.5\ndensity = 0\n", "above 0"));
}

const std::string kTown = "[town]\nblock_m = 12\nstreet_m = 12\nmax_height_m = 4.5\n";

TEST(MovingCars, are_as_many_as_asked_for_and_drive_at_half_to_full_speed) {
  Scene scene = level_scene(kTown + "[effects.moving_cars]\nper_100m = 4\n");
  const MovingCarsEffect effect(*scene.effects.moving_cars, scene, {});
  const SmallFlight flight(level_scene(""));
  const Box2d extent{{-600, -600}, {600, 600}};
  const std::vector<MovingCar> now = effect.cars_at(0, extent, flight.world),
                               later = effect.cars_at(0.1, extent, flight.world);
  const double length_m = 1200 * (1200 / 24.0);
  EXPECT_NEAR(static_cast<double>(now.size()), 0.04 * length_m, 0.05 * 0.04 * length_m);
  // Cars lie 7 m apart at least: within a metre of where one was stands the same.
  int found = 0;
  for (const MovingCar& a : now)
    for (const MovingCar& b : later)
      if (norm(b.center - a.center) < 1.5) {
        ++found;
        EXPECT_GE(norm(b.center - a.center), 0.45 - 1e-9);
        EXPECT_LE(norm(b.center - a.center), 0.9 + 1e-9);
        EXPECT_GT(dot(b.center - a.center, a.axis_u), 0);
      }
  EXPECT_GT(found, 0.98 * static_cast<double>(now.size()));
}

TEST(MovingCars, differ_between_photographs_from_the_same_place) {
  const std::string slow = "[effects]\nspeed_mps = 0.5\n";
  std::vector<camera::Pose> poses = north_and_back();
  for (camera::Pose& pose : poses) pose.center.x += 12;  // over a street
  const SmallFlight parked(level_scene(kTown), poses),
      flight(level_scene(kTown + "[effects.moving_cars]\nper_100m = 14\n" + slow), poses);
  EXPECT_EQ(parked.photograph(0), parked.photograph(2));
  const Array2d<Rgb8> first = flight.photograph(0), third = flight.photograph(2), none = parked.photograph(0);
  int moved = 0, with_cars = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    moved += first.data()[i] != third.data()[i];
    with_cars += first.data()[i] != none.data()[i];
  }
  EXPECT_GT(moved, 50);
  EXPECT_GT(with_cars, 50);
  EXPECT_FALSE(flight.world.moment().traffic);
}

TEST(MovingCars, need_streets_and_a_number) {
  EXPECT_TRUE(refused("[effects.moving_cars]\nper_100m = 4\n", "needs streets"));
  EXPECT_TRUE(refused(kTown + "[effects.moving_cars]\nper_100m = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[town]\nstreet_m = 6\n[effects.moving_cars]\nper_100m = 4\n", "pass parked cars"));
}

}  // namespace
}  // namespace skysweep::scene
