// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/vignetting.h"

#include <algorithm>
#include <cmath>

namespace skysweep::scene {
namespace {

constexpr int kSteps = 2048;

}  // namespace

std::vector<Dial> dials(Vignetting& s) { return {{"strength", &s.strength, kAboveZero, 10, true}}; }

VignettingEffect::VignettingEffect(const Vignetting& settings, const Scene& scene, const std::vector<Shot>&)
    : ImageEffect(EffectId::vignetting), camera_(scene.camera) {
  const double x = std::max(camera_.cx_px, camera_.width_px - camera_.cx_px) / camera_.fx_px;
  const double y = std::max(camera_.cy_px, camera_.height_px - camera_.cy_px) / camera_.fy_px;
  const double farthest = x * x + y * y;
  per_step_ = kSteps / farthest;
  for (int i = 0; i <= kSteps + 1; ++i) {
    // cos^2 of the field angle is 1 / (1 + r^2), r without distortion. Where the lens model ends the last value stands.
    const double distorted = std::sqrt(std::min(i, kSteps) / per_step_);
    const auto r = camera::undistort(camera_.distortion, {distorted, 0});
    factor_.push_back(r ? static_cast<float>(std::pow(1 + dot(*r, *r), -2 * settings.strength)) : factor_.back());
  }
}

void VignettingEffect::develop(const Shot&, int row, LinearRgb* pixels, int width) const {
  const double y = (row + 0.5 - camera_.cy_px) / camera_.fy_px;
  for (int column = 0; column < width; ++column) {
    const double x = (column + 0.5 - camera_.cx_px) / camera_.fx_px;
    const auto position = static_cast<float>(per_step_ * (x * x + y * y));
    const auto i = static_cast<std::size_t>(position);
    const float factor = factor_[i] + (position - static_cast<float>(i)) * (factor_[i + 1] - factor_[i]);
    pixels[column] = factor * pixels[column];
  }
}

}  // namespace skysweep::scene
