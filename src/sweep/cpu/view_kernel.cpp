// SPDX-License-Identifier: Apache-2.0
#include "sweep/cpu/view_kernel.h"

#include <cmath>

#include "sweep/sampling_level.h"

namespace skysweep::sweep::cpu {

ViewKernel make_view_kernel(const View& view, const SweepOptions& options) {
  const camera::CameraModel& model = view.camera.model();
  ViewKernel kernel;
  kernel.cam_from_world = view.camera.pose().cam_from_world;
  kernel.center = view.camera.pose().center;
  kernel.fx = model.fx_px, kernel.fy = model.fy_px;
  kernel.cx = model.cx_px, kernel.cy = model.cy_px;
  kernel.distortion = model.distortion;
  kernel.fold_radius_squared = camera::fold_radius_squared(model.distortion);
  kernel.width = static_cast<float>(model.width_px);
  kernel.height = static_cast<float>(model.height_px);
  kernel.camera = &view.camera;
  kernel.gain = static_cast<float>(view.gain);
  kernel.offset = static_cast<float>(view.offset * kLuminanceScale);
  for (int window = options.window_level_min; window <= options.window_level_max; ++window) {
    const int level = sampling_level(view, window);
    const LuminanceLevel& image = view.image->luminance(level);
    kernel.levels[window - options.window_level_min] = {image.pairs.data(), image.stride, image.width, image.height,
                                                        std::ldexp(1.0f, -level)};
  }
  return kernel;
}

}  // namespace skysweep::sweep::cpu
