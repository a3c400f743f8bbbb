// SPDX-License-Identifier: Apache-2.0
// Effects of metadata: errors of poses, wrong time stamps.
#include "scene/effects/pose_error.h"
#include "scene/effects/small_flight.h"
#include "scene/effects/time_jitter.h"

namespace skysweep::scene {
namespace {

constexpr std::size_t kShots = 3000;

// A long straight flight north at 8 m/s.
std::vector<Shot> long_flight() {
  std::vector<Shot> out;
  for (std::size_t i = 0; i < kShots; ++i)
    out.push_back({static_cast<int>(i), static_cast<double>(i), {{}, {0, 8.0 * static_cast<double>(i), 6}}, {0, 8, 0}});
  return out;
}

std::vector<formats::PosedImage> poses_of(const std::vector<Shot>& shots) {
  std::vector<formats::PosedImage> out;
  for (const Shot& shot : shots) out.push_back({"", {}, shot.pose, ""});
  return out;
}

struct Deviations {
  Vec3d sigma;             // of the coordinates
  double neighbours;       // correlation of one coordinate with that of the next photograph
  double angle_sigma_deg;  // about one axis
};

Deviations measure(const std::vector<Shot>& shots, const std::vector<formats::PosedImage>& recorded) {
  Vec3d squares;
  double along = 0, angles = 0;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const Vec3d d = recorded[i].pose.center - shots[i].pose.center;
    squares = squares + Vec3d{d.x * d.x, d.y * d.y, d.z * d.z};
    if (i > 0) along += d.x * (recorded[i - 1].pose.center - shots[i - 1].pose.center).x;
    const Mat3d turn = recorded[i].pose.cam_from_world * transpose(shots[i].pose.cam_from_world);
    angles += std::pow(std::acos(std::min(1.0, 0.5 * (turn(0, 0) + turn(1, 1) + turn(2, 2) - 1))), 2) / 3;
  }
  const double n = static_cast<double>(shots.size());
  return {{std::sqrt(squares.x / n), std::sqrt(squares.y / n), std::sqrt(squares.z / n)},
          along / squares.x,
          std::sqrt(angles / n) * 180 / 3.14159265358979};
}

TEST(PoseError, white_errors_have_the_deviation_asked_for_and_know_nothing_of_their_neighbours) {
  PoseError settings;
  settings.position_sigma_m = 0.4;
  settings.angle_sigma_deg = 0.5;
  const std::vector<Shot> shots = long_flight();
  std::vector<formats::PosedImage> recorded = poses_of(shots);
  PoseErrorEffect(settings, {}, shots).spoil(shots, recorded);
  const Deviations d = measure(shots, recorded);
  for (const double sigma : {d.sigma.x, d.sigma.y, d.sigma.z}) EXPECT_NEAR(sigma, 0.4, 0.025);
  EXPECT_NEAR(d.neighbours, 0, 0.08);
  EXPECT_NEAR(d.angle_sigma_deg, 0.5, 0.025);
  for (const formats::PosedImage& image : recorded) EXPECT_FALSE(image.pose.problem());
}

TEST(PoseError, drifts_are_shared_by_neighbours) {
  PoseError settings;
  settings.position_drift_m = 0.4;
  settings.angle_drift_deg = 0.5;
  settings.correlation_photographs = 4;
  const std::vector<Shot> shots = long_flight();
  std::vector<formats::PosedImage> recorded = poses_of(shots);
  PoseErrorEffect(settings, {}, shots).spoil(shots, recorded);
  const Deviations d = measure(shots, recorded);
  for (const double sigma : {d.sigma.x, d.sigma.y, d.sigma.z}) EXPECT_NEAR(sigma, 0.4, 0.05);
  EXPECT_NEAR(d.neighbours, std::exp(-0.25), 0.05);
  EXPECT_NEAR(d.angle_sigma_deg, 0.5, 0.05);
}

TEST(PoseError, nothing_and_wrong_numbers_are_refused) {
  EXPECT_TRUE(refused("[effects.pose_error]\n", "set position_sigma_m"));
  EXPECT_TRUE(refused("[effects.pose_error]\nangle_sigma_deg = 46\n", "between 0 and 45"));
  EXPECT_TRUE(refused("[effects.pose_error]\nangle_sigma_deg = 1\ncorrelation_photographs = 0\n", "above 0"));
}

TEST(TimeJitter, moves_positions_along_the_path_by_speed_times_time) {
  TimeJitter settings;
  settings.sigma_s = 0.05;
  settings.offset_s = 0.2;
  const std::vector<Shot> shots = long_flight();
  std::vector<formats::PosedImage> recorded = poses_of(shots);
  TimeJitterEffect(settings, {}, shots).spoil(shots, recorded);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < kShots; ++i) {
    const Vec3d d = recorded[i].pose.center - shots[i].pose.center;
    EXPECT_EQ(d.x, 0);
    EXPECT_EQ(d.z, 0);
    EXPECT_EQ(recorded[i].pose.cam_from_world, shots[i].pose.cam_from_world);
    sum += d.y, squares += d.y * d.y;
  }
  const double n = static_cast<double>(kShots), mean = sum / n;
  EXPECT_NEAR(mean, 8 * 0.2, 0.03);
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 8 * 0.05, 0.025);
}

TEST(TimeJitter, nothing_and_wrong_numbers_are_refused) {
  EXPECT_TRUE(refused("[effects.time_jitter]\n", "set sigma_s or offset_s"));
  EXPECT_TRUE(refused("[effects.time_jitter]\nsigma_s = -1\n", "between 0 and 3600"));
}

}  // namespace
}  // namespace skysweep::scene
