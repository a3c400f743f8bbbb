// SPDX-License-Identifier: Apache-2.0
// A photograph of the world: four rays a pixel, more where they disagree, and what sensor and exposure add.
#pragma once

#include <cstdint>

#include "camera/pose.h"
#include "core/array2d.h"
#include "core/color.h"
#include "core/executor.h"
#include "scene/render/photograph_effects.h"
#include "scene/render/pixel_rays.h"
#include "scene/world/world.h"

namespace skysweep::scene {

struct Exposure {
  double gain = 1;         // factor on linear light
  double noise_sigma = 0;  // grey levels; 0: no noise
  std::uint64_t noise_seed = 0;
};

// Four samples of each pixel, then four more at a time while the standard error of their mean is above the limit.
// Motion blur and defocus have numbers of samples of their own.
struct Sampling {
  static constexpr int kMostSamples = 64;  // of a pixel
  float max_error_levels = 0;              // of luminance, grey levels; 0: four samples are enough
};

// `effects` are those that the scene names, or null.
Array2d<Rgb8> take_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                              const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                              const PhotographEffects* effects = nullptr, const Sampling& sampling = {});

// The same as linear light times exposure.gain, without noise_sigma, which is noise of grey levels. Black where the
// lens model does not reach.
Array2d<LinearRgb> take_linear_photograph(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                                          const camera::Pose& pose, const Exposure& exposure, Executor& executor,
                                          const PhotographEffects* effects = nullptr, const Sampling& sampling = {});

}  // namespace skysweep::scene
