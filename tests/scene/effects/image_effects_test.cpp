// SPDX-License-Identifier: Apache-2.0
// Effects of air, lens, exposure and sensor: haze, vignetting, exposure drift, sensor noise.
#include "scene/effects/exposure_drift.h"
#include "scene/effects/haze.h"
#include "scene/effects/sensor_noise.h"
#include "scene/effects/small_flight.h"

namespace skysweep::scene {
namespace {

TEST(Haze, black_rises_with_the_distance_and_contrast_falls_to_2_percent_at_the_visibility) {
  Haze settings;
  settings.visibility_m = 500;
  settings.color = {0.5, 0.6, 0.7};
  const HazeEffect haze(settings, {}, {});
  for (const double way_m : {50.0, 250.0, 500.0}) {
    const Ray ray{{0, 0, way_m}, {0, 0, -1}};
    const Ray rays[2] = {ray, ray};
    SurfacePoint ground;
    ground.face = Face::ground;
    const SurfacePoint hits[2] = {ground, ground};
    LinearRgb light[2] = {{0, 0, 0}, {1, 1, 1}};
    haze.dim(rays, hits, 2, light);
    const double kept = std::pow(0.02, way_m / 500);
    EXPECT_NEAR(light[0].r, 0.5 * (1 - kept), 1e-5);
    EXPECT_NEAR(light[0].b, 0.7 * (1 - kept), 1e-5);
    EXPECT_NEAR(light[1].g - light[0].g, kept, 1e-5);
  }
}

TEST(Haze, a_photograph_shows_it) {
  const Rgb8 plain = picture_of("")(32, 24), hazy = picture_of("[effects.haze]\nvisibility_m = 30\n")(32, 24);
  const double kept = std::pow(0.02, kAltitude_m / 30);
  EXPECT_NEAR(light_of(hazy.r), kept * light_of(plain.r) + (1 - kept) * 0.60, 0.01);
  EXPECT_NEAR(light_of(hazy.b), kept * light_of(plain.b) + (1 - kept) * 0.78, 0.01);
  EXPECT_TRUE(refused("[effects.haze]\nvisibility_m = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.haze]\n", "set its visibility_m"));
  EXPECT_TRUE(refused("[effects.haze]\nvisibility_m = 9\ncolor = [1, 1]\n", "three numbers"));
}

TEST(Vignetting, corners_get_the_fourth_power_of_the_cosine_of_the_field_angle) {
  const Array2d<Rgb8> plain = picture_of("[texture]\ncontrast = 0\n"),
                      natural = picture_of("[texture]\ncontrast = 0\n[effects.vignetting]\nstrength = 1\n"),
                      strong = picture_of("[texture]\ncontrast = 0\n[effects.vignetting]\nstrength = 2\n");
  const double x = (0.5 - 32) / 60, y = (0.5 - 24) / 60, cos2 = 1 / (1 + x * x + y * y);
  for (const auto& [column, row] : {std::pair{0, 0}, {63, 0}, {63, 47}}) {
    EXPECT_NEAR(light_of(natural(column, row).g) / light_of(plain(column, row).g), cos2 * cos2, 0.015);
    EXPECT_NEAR(light_of(strong(column, row).g) / light_of(plain(column, row).g), std::pow(cos2, 4), 0.015);
  }
  EXPECT_NEAR(natural(32, 24).g, plain(32, 24).g, 1);
  EXPECT_TRUE(refused("[effects.vignetting]\nstrength = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.vignetting]\nstrength = 11\n", "at most 10"));
}

TEST(ExposureDrift, gains_have_the_spread_asked_for_and_red_goes_against_blue) {
  ExposureDrift settings;
  settings.stops = 0.3;
  settings.white_balance = 0.05;
  settings.correlation_photographs = 2;
  const std::vector<Shot> shots(4000);
  const ExposureDriftEffect effect(settings, Scene{}, shots);
  double stops2 = 0, warmth2 = 0, neighbours = 0;
  for (int i = 0; i < 4000; ++i) {
    const LinearRgb g = effect.gain(i);
    EXPECT_NEAR(g.r * g.b, g.g * g.g, 1e-4 * g.g * g.g);
    stops2 += std::pow(std::log2(g.g), 2);
    warmth2 += std::pow(std::log(g.r / g.g), 2);
    if (i > 0) neighbours += std::log2(g.g) * std::log2(effect.gain(i - 1).g);
  }
  EXPECT_NEAR(std::sqrt(stops2 / 4000), 0.3, 0.02);
  EXPECT_NEAR(std::sqrt(warmth2 / 4000), 0.05, 0.004);
  EXPECT_NEAR(neighbours / stops2, std::exp(-0.5), 0.05);
}

TEST(ExposureDrift, each_photograph_has_one_gain) {
  const SmallFlight plain(level_scene("")), flight(level_scene("[effects.exposure_drift]\nstops = 1\n"));
  std::vector<double> gains;
  for (const std::size_t index : {0u, 1u, 2u}) {
    const Array2d<Rgb8> a = plain.photograph(index), b = flight.photograph(index);
    gains.push_back(light_of(b(32, 24).g) / light_of(a(32, 24).g));
    EXPECT_NEAR(light_of(b(3, 40).g) / light_of(a(3, 40).g), gains.back(), 0.03 * gains.back());
    EXPECT_NEAR(light_of(b(3, 40).r) / light_of(a(3, 40).r), gains.back(), 0.03 * gains.back());
  }
  EXPECT_GT(std::abs(gains[1] / gains[0] - 1), 0.02);
  EXPECT_GT(std::abs(gains[2] / gains[1] - 1), 0.02);
  EXPECT_TRUE(refused("[effects.exposure_drift]\n", "set stops or white_balance"));
  EXPECT_TRUE(refused("[effects.exposure_drift]\nstops = 6\n", "between 0 and 5"));
}

// Mean and variance of a sensor's answer to a constant light.
std::pair<double, double> answers(double iso, float light, double read_noise_e) {
  SensorNoise settings;
  settings.iso = iso;
  settings.read_noise_e = read_noise_e;
  const SensorNoiseEffect effect(settings, {}, {});
  double sum = 0, squares = 0;
  constexpr int kRows = 100, kWidth = 200;
  for (int row = 0; row < kRows; ++row) {
    std::vector<LinearRgb> pixels(kWidth, {light, light, light});
    effect.develop({}, row, pixels.data(), kWidth);
    for (const LinearRgb& p : pixels)
      for (const float v : {p.r, p.g, p.b}) sum += v, squares += double{v} * v;
  }
  const double n = 3.0 * kRows * kWidth, mean = sum / n;
  return {mean, squares / n - mean * mean};
}

TEST(SensorNoise, variance_grows_linearly_with_light_and_iso) {
  for (const double iso : {100.0, 400.0, 1600.0})
    for (const float light : {0.05f, 0.2f, 0.8f}) {
      const double electrons_of_white = 20000 * 100 / iso;
      const auto [mean, variance] = answers(iso, light, 3);
      const double expected = (light * electrons_of_white + 9) / (electrons_of_white * electrons_of_white);
      EXPECT_NEAR(mean, light, 5 * std::sqrt(expected / 60000));
      EXPECT_NEAR(variance, expected, 0.03 * expected) << iso << " " << light;
    }
}

TEST(SensorNoise, darkness_has_the_read_noise_alone) {
  EXPECT_NEAR(std::sqrt(answers(100, 0, 10).second), 10.0 / 20000, 0.03 * 10 / 20000);
  EXPECT_EQ(answers(100, 0, 0).second, 0);
}

TEST(SensorNoise, is_another_in_every_photograph_and_wrong_numbers_are_refused) {
  const SmallFlight flight(level_scene("[effects.sensor_noise]\niso = 6400\n"));
  EXPECT_NE(flight.photograph(0), flight.photograph(2));
  EXPECT_EQ(flight.photograph(0), flight.photograph(0));
  EXPECT_TRUE(refused("[effects.sensor_noise]\niso = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.sensor_noise]\nread_noise_e = 4\n", "set its iso"));
}

}  // namespace
}  // namespace skysweep::scene
