// SPDX-License-Identifier: Apache-2.0
// The picture of a map from a view: rays, hits, shadows, colours.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/array2d.h"
#include "core/color.h"
#include "core/executor.h"
#include "render/shading.h"
#include "render/tracer.h"
#include "render/view.h"

namespace skysweep::render {

struct PictureOptions {
  int samples = 2;              // samples^2 rays a pixel
  bool level_of_detail = true;  // squares of the hierarchy smaller than a ray's share of a pixel are not looked into
};

// Called after each band of rows with the share that is done; false stops, and the rest stays background.
using OnBand = std::function<bool(double share)>;

// Rows are done in bands on the executor; the same bytes for any number of threads.
Array2d<Rgb8> draw_picture(const View& view, const Shading& shading, const LookOptions& look,
                           const PictureOptions& options, Tracer& tracer, Executor& executor, const OnBand& on_band);

// What a ray through the middle of each pixel meets; NaN where that is nothing.
struct PictureLayers {
  Array2d<float> distance_m;
  Array2d<float> x_m, y_m, z_m;  // from `origin`, which keeps large coordinates within what a float holds
  Array2d<float> normal_x, normal_y, normal_z;
  Array2d<float> level;
  Vec3d origin;
};
PictureLayers draw_layers(const View& view, const Shading& shading, Vec3d origin, Tracer& tracer, Executor& executor);

}  // namespace skysweep::render
