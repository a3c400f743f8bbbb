// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/pose_error.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "scene/effects/drift.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kPoseErrorStream = 0xeff0e1;

}  // namespace

std::vector<Dial> dials(PoseError& s) {
  return {{"position_sigma_m", &s.position_sigma_m, 0, 1000},
          {"position_drift_m", &s.position_drift_m, 0, 1000},
          {"angle_sigma_deg", &s.angle_sigma_deg, 0, 45},
          {"angle_drift_deg", &s.angle_drift_deg, 0, 45},
          {"correlation_photographs", &s.correlation_photographs, kAboveZero}};
}

PoseErrorEffect::PoseErrorEffect(const PoseError& settings, const Scene& scene, const std::vector<Shot>&)
    : MetadataEffect(EffectId::pose_error), settings_(settings), seed_(mix64(scene.seed) ^ kPoseErrorStream) {
  if (settings.position_sigma_m + settings.position_drift_m + settings.angle_sigma_deg + settings.angle_drift_deg == 0)
    throw usage_error(settings.named_at +
                      " has no effect: set position_sigma_m, position_drift_m, angle_sigma_deg or angle_drift_deg "
                      "above 0, or leave the table out");
}

void PoseErrorEffect::spoil(const std::vector<Shot>& shots, std::vector<formats::PosedImage>& images) const {
  const int count = static_cast<int>(shots.size());
  const auto drifting = [&](std::uint64_t which) {
    return drift(count, settings_.correlation_photographs, mix64(seed_ + which));
  };
  const std::vector<double> east = drifting(1), north = drifting(2), up = drifting(3);
  const std::vector<double> about_x = drifting(4), about_y = drifting(5), about_z = drifting(6);
  Random random(seed_);
  const double degree = std::numbers::pi / 180;
  for (std::size_t i = 0; i < images.size(); ++i) {
    camera::Pose& pose = images[i].pose;
    const Vec3d white{random.normal(), random.normal(), random.normal()};
    const Vec3d white_turn{random.normal(), random.normal(), random.normal()};
    const Vec3d turn = settings_.angle_sigma_deg * degree * white_turn +
                       settings_.angle_drift_deg * degree * Vec3d{about_x[i], about_y[i], about_z[i]};
    pose.center = camera::snap_position(pose.center + settings_.position_sigma_m * white +
                                        settings_.position_drift_m * Vec3d{east[i], north[i], up[i]});
    pose.cam_from_world = rotation_about(turn) * pose.cam_from_world;
  }
}

Mat3d rotation_about(Vec3d turn) {
  const double angle = norm(turn);
  if (angle == 0) return {};
  const Vec3d k = (1 / angle) * turn;
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {{c + d * k.x * k.x, d * k.x * k.y - s * k.z, d * k.x * k.z + s * k.y,  //
           d * k.y * k.x + s * k.z, c + d * k.y * k.y, d * k.y * k.z - s * k.x,  //
           d * k.z * k.x - s * k.y, d * k.z * k.y + s * k.x, c + d * k.z * k.z}};
}

}  // namespace skysweep::scene
