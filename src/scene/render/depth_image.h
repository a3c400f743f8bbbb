// SPDX-License-Identifier: Apache-2.0
// How far what a photograph shows is away.
#pragma once

#include "camera/pose.h"
#include "core/array2d.h"
#include "core/executor.h"
#include "scene/render/pixel_rays.h"
#include "scene/world/world.h"

namespace skysweep::scene {

// Depth along the view direction (camera::Camera::depth), metres, of the first surface at the centre of each pixel; NaN
// where there is none or the lens model does not reach.
Array2d<float> depth_image(const World& world, const camera::CameraModel& model, const PixelRays& rays,
                           const camera::Pose& pose, Executor& executor);

}  // namespace skysweep::scene
