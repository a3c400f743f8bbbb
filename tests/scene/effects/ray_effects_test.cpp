// SPDX-License-Identifier: Apache-2.0
// Effects of moment and lens: rolling shutter, motion blur, defocus, chromatic aberration.
#include <algorithm>

#include "scene/effects/defocus.h"
#include "scene/effects/small_flight.h"

namespace skysweep::scene {
namespace {

// Detail that a pixel's few samples can follow.
const std::string kCoarse = "[texture]\ncontrast = 4\nfinest_m = 0.4\n";

using Light = Array2d<Vec3d>;  // linear

Light light_of_picture(const Array2d<Rgb8>& photo) {
  Light out(photo.width(), photo.height());
  for (std::size_t i = 0; i < photo.size(); ++i)
    out.data()[i] = {light_of(photo.data()[i].r), light_of(photo.data()[i].g), light_of(photo.data()[i].b)};
  return out;
}

// The mean of photographs without effects from places around that of the first: what a level scene looks like when
// light comes from all of them.
Light mean_over(const std::vector<Vec2d>& offsets) {
  std::vector<camera::Pose> poses;
  for (const Vec2d offset : offsets) {
    poses.push_back(north_and_back()[0]);
    poses.back().center = poses.back().center + Vec3d{offset.x, offset.y, 0};
  }
  const SmallFlight flight(level_scene(kCoarse), poses);
  Light sum(64, 48);
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const Light one = light_of_picture(flight.photograph(pose));
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum.data()[i] = sum.data()[i] + 1.0 / static_cast<double>(poses.size()) * one.data()[i];
  }
  return sum;
}

double rms(const Light& a, const Light& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(norm(a.data()[i] - b.data()[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<Vec2d> along_path(double length_m) {
  std::vector<Vec2d> out;
  for (int i = 0; i < 24; ++i) out.push_back({0, ((i + 0.5) / 24 - 0.5) * length_m});
  return out;
}

std::vector<Vec2d> across_path(double length_m) {
  std::vector<Vec2d> out = along_path(length_m);
  for (Vec2d& offset : out) offset = {offset.y, 0};
  return out;
}

std::vector<Vec2d> over_disc(double diameter_m) {
  std::vector<Vec2d> out;
  for (int y = -4; y <= 4; ++y)
    for (int x = -4; x <= 4; ++x)
      if (x * x + y * y <= 4.5 * 4.5) out.push_back({x * diameter_m / 9, y * diameter_m / 9});
  return out;
}

TEST(RollingShutter, the_last_row_sees_what_lies_way_over_gsd_farther_ahead) {
  // (47 + 0.5 - 24) / 48 of the readout after the middle at 8 m/s: 0.3 m.
  const Array2d<Rgb8> plain = picture_of(""), rolled = picture_of("[effects.rolling_shutter]\nreadout_s = " +
                                                                  std::to_string(0.0375 / 23.5 * 48));
  int differing = 0;
  for (int x = 0; x < 64; ++x) {
    EXPECT_NEAR(rolled(x, 47).g, plain(x, 44).g, 1) << x;
    EXPECT_NEAR(rolled(x, 0).g, plain(x, 3).g, 1) << x;
    differing += rolled(x, 47) != plain(x, 47);
  }
  EXPECT_GT(differing, 32);
}

TEST(RollingShutter, zero_wrong_and_missing_readouts_are_refused) {
  EXPECT_TRUE(refused("[effects.rolling_shutter]\nreadout_s = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.rolling_shutter]\nreadout_s = 11\n", "at most 10"));
  EXPECT_TRUE(refused("[effects.rolling_shutter]\n", "set its readout_s"));
}

TEST(MotionBlur, is_the_mean_along_the_path_over_speed_times_exposure) {
  const Light plain = light_of_picture(picture_of(kCoarse));
  for (const double blur_m : {0.3, 0.6}) {
    const Light blurred =
        light_of_picture(picture_of(kCoarse + "[effects.motion_blur]\nexposure_s = " + std::to_string(blur_m / 8)));
    const double off = rms(blurred, mean_over(along_path(blur_m)));
    EXPECT_LT(off, 0.15 * rms(plain, blurred)) << blur_m;
    for (const auto& wrong : {across_path(blur_m), along_path(0.7 * blur_m), along_path(1.4 * blur_m)})
      EXPECT_LT(2 * off, rms(blurred, mean_over(wrong))) << blur_m;
  }
}

TEST(MotionBlur, follows_the_speed_of_the_flight) {
  EXPECT_EQ(picture_of("[effects]\nspeed_mps = 16\n[effects.motion_blur]\nexposure_s = 0.02\n"),
            picture_of("[effects]\nspeed_mps = 4\n[effects.motion_blur]\nexposure_s = 0.08\n"));
}

TEST(MotionBlur, zero_and_wrong_exposures_are_refused) {
  EXPECT_TRUE(refused("[effects.motion_blur]\nexposure_s = 0\n", "leave the table out"));
  EXPECT_TRUE(refused("[effects.motion_blur]\nexposure_s = -1\n", "above 0"));
  EXPECT_TRUE(refused("[effects.haze]\nvisibility_m = 9\n[effects]\nspeed_mps = 9\n", "has no effect"));
}

TEST(Defocus, spreads_points_over_the_disc_of_a_thin_lens) {
  const Light plain = light_of_picture(picture_of(kCoarse));
  for (const double aperture_m : {0.3, 0.6}) {
    Defocus settings;
    settings.aperture_mm = 1e3 * aperture_m;
    settings.focus_distance_m = 3;
    EXPECT_NEAR(blur_disc_px(settings, 60, kAltitude_m), aperture_m / kPicture_gsd_m, 1e-12);
    const Light blurred = light_of_picture(picture_of(
        kCoarse + "[effects.defocus]\nfocus_distance_m = 3\naperture_mm = " + std::to_string(1e3 * aperture_m)));
    // Twice as far as the focus the cone of rays is as wide again as the lens.
    const double off = rms(blurred, mean_over(over_disc(aperture_m)));
    EXPECT_LT(off, 0.2 * rms(plain, blurred)) << aperture_m;  // few samples on the lens make some noise
    for (const double wrong : {0.7, 1.4})
      EXPECT_LT(2 * off, rms(blurred, mean_over(over_disc(wrong * aperture_m)))) << aperture_m;
  }
}

TEST(Defocus, a_lens_focused_on_the_ground_changes_nothing_there) {
  const Array2d<Rgb8> plain = picture_of(""),
                      sharp = picture_of("[effects.defocus]\naperture_mm = 600\nfocus_distance_m = 6\n");
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(sharp.data()[i].g, plain.data()[i].g, 1);
}

TEST(Defocus, half_a_lens_and_zero_are_refused) {
  EXPECT_TRUE(refused("[effects.defocus]\naperture_mm = 3\n", "set its focus_distance_m"));
  EXPECT_TRUE(refused("[effects.defocus]\naperture_mm = 0\nfocus_distance_m = 3\n", "leave the table out"));
}

TEST(ChromaticAberration, red_and_blue_are_images_of_another_size) {
  const Array2d<Rgb8> plain = picture_of(""),
                      fringed = picture_of("[effects.chromatic_aberration]\nred_px = 2\nblue_px = -1\n");
  // The corner lies 40 pixels from the middle: red is 42/40, blue 39/40 as large as green.
  const auto with_focal_length = [](double focal_px) {
    Scene scene = level_scene();
    scene.camera.fx_px = scene.camera.fy_px = focal_px;
    return SmallFlight(scene).photograph();
  };
  const Array2d<Rgb8> larger = with_focal_length(60 * 42. / 40), smaller = with_focal_length(60 * 39. / 40);
  int red_differs = 0, blue_differs = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const Rgb8 p = fringed.data()[i];
    EXPECT_NEAR(p.r, larger.data()[i].r, 1);
    EXPECT_EQ(p.g, plain.data()[i].g);
    EXPECT_NEAR(p.b, smaller.data()[i].b, 1);
    red_differs += std::abs(p.r - plain.data()[i].r) > 1;
    blue_differs += std::abs(p.b - plain.data()[i].b) > 1;
  }
  EXPECT_GT(red_differs, 500);
  EXPECT_GT(blue_differs, 250);
}

TEST(ChromaticAberration, nothing_and_too_much_are_refused) {
  EXPECT_TRUE(refused("[effects.chromatic_aberration]\n", "set red_px or blue_px"));
  EXPECT_TRUE(refused("[effects.chromatic_aberration]\nred_px = 30\n", "tenth of the photograph"));
}

}  // namespace
}  // namespace skysweep::scene
