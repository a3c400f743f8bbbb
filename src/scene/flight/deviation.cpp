// SPDX-License-Identifier: Apache-2.0
#include "scene/flight/deviation.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kFlightStream = 0xf1, kDriftStream = 0xf2;

std::uint64_t stream(std::uint64_t scene_seed, std::uint64_t kind, int number) {
  return mix64(scene_seed + static_cast<std::uint64_t>(number) * 0x10001) ^ kind;
}

}  // namespace

Deviations::Deviations(const Flight& flight, std::uint64_t scene_seed, int number)
    : flight_(flight),
      scatter_(stream(scene_seed, kFlightStream, number)),
      drift_(flight, stream(scene_seed, kDriftStream, number)) {}

void Deviations::advance() {
  offset_ = {scatter_.normal(), scatter_.normal(), scatter_.normal()};
  turn_ = {scatter_.normal(), scatter_.normal(), scatter_.normal()};
  drifted_ = drift_.next();
}

camera::Pose Deviations::flown(const PlannedPose& planned) const {
  const double yaw = planned.yaw_deg + 2 * flight_.tilt_sigma_deg * turn_.x + drifted_.yaw_deg;
  const double pitch = planned.pitch_deg + flight_.tilt_sigma_deg * turn_.y + drifted_.pitch_deg;
  const double roll = planned.roll_deg + flight_.tilt_sigma_deg * turn_.z + drifted_.roll_deg;
  const Vec3d position = planned.position + flight_.position_sigma_m * offset_ + drifted_.position_m;
  return {camera::rotation_from_yaw_pitch_roll(yaw, pitch, roll), camera::snap_position(position)};
}

}  // namespace skysweep::scene
