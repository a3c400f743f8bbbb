// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/time_jitter.h"

#include "core/error.h"
#include "core/random.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kJitterStream = 0xeff714;

}  // namespace

std::vector<Dial> dials(TimeJitter& s) {
  return {{"sigma_s", &s.sigma_s, 0, 3600}, {"offset_s", &s.offset_s, -3600, 3600}};
}

TimeJitterEffect::TimeJitterEffect(const TimeJitter& settings, const Scene& scene, const std::vector<Shot>&)
    : MetadataEffect(EffectId::time_jitter), settings_(settings), seed_(mix64(scene.seed) ^ kJitterStream) {
  if (settings.sigma_s == 0 && settings.offset_s == 0)
    throw usage_error(settings.named_at + " has no effect: set sigma_s or offset_s, or leave the table out");
}

void TimeJitterEffect::spoil(const std::vector<Shot>& shots, std::vector<formats::PosedImage>& images) const {
  Random random(seed_);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double late_s = settings_.offset_s + settings_.sigma_s * random.normal();
    camera::Pose& pose = images[i].pose;
    pose.center = camera::snap_position(pose.center + late_s * shots[i].velocity_mps);
  }
}

}  // namespace skysweep::scene
