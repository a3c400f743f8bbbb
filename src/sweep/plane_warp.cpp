// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skysweep::sweep {

namespace {
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
}

PixelRays::PixelRays(const View& view, int of_level)
    : level(of_level),
      width(view.image->luminance(level).width),
      height(view.image->luminance(level).height),
      center(view.camera.pose().center) {
  const double pixel_size = std::ldexp(1.0, level);
  east.reserve(static_cast<std::size_t>(width) * height);
  north.reserve(east.capacity());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto ray = view.camera.ray({(x + 0.5) * pixel_size, (y + 0.5) * pixel_size});
      const bool down = ray && ray->z < 0;
      east.push_back(down ? ray->x / -ray->z : kNowhere);
      north.push_back(down ? ray->y / -ray->z : kNowhere);
    }
  }
}

PlaneWarp::PlaneWarp(const PixelRays& reference, const View& neighbour)
    : reference_(reference),
      luminance_(neighbour.image->luminance(std::min(reference.level, neighbour.image->levels() - 1))),
      model_(neighbour.camera.model()),
      fold_radius_squared_(camera::fold_radius_squared(model_.distortion)),
      scale_(std::ldexp(1.0, -std::min(reference.level, neighbour.image->levels() - 1))),
      center_(neighbour.camera.pose().cam_from_world * (reference.center - neighbour.camera.pose().center)),
      column_(reference.width),
      row_(reference.width) {
  const std::size_t count = reference.east.size();
  x_.resize(count), y_.resize(count), z_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d way = neighbour.camera.pose().cam_from_world * Vec3d{reference.east[i], reference.north[i], -1};
    x_[i] = way.x, y_[i] = way.y, z_[i] = way.z;
  }
}

// The whole row before any pixel is sampled: no division waits for another.
void PlaneWarp::place_row(int row, double depth_m) {
  const std::size_t start = static_cast<std::size_t>(row) * reference_.width;
  const double *way_x = x_.data() + start, *way_y = y_.data() + start, *way_z = z_.data() + start;
  double *columns = column_.data(), *rows = row_.data();
  const camera::Distortion d = model_.distortion;
  const double fx = model_.fx_px, fy = model_.fy_px, cx = model_.cx_px, cy = model_.cy_px;
  const double right = model_.width_px, bottom = model_.height_px, fold = fold_radius_squared_, scale = scale_;
  const Vec3d center = center_;
  for (int i = 0; i < reference_.width; ++i) {
    const double depth = center.z + depth_m * way_z[i];
    const double x = (center.x + depth_m * way_x[i]) / depth, y = (center.y + depth_m * way_y[i]) / depth;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
    const double column = fx * (x * radial + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x)) + cx;
    const double line = fy * (y * radial + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y) + cy;
    const bool shown = (depth > 0) & (r2 < fold) & (column >= 0) & (line >= 0) & (column <= right) & (line <= bottom);
    columns[i] = shown ? column * scale : -1;
    rows[i] = line * scale;
  }
}

void PlaneWarp::warp(double depth_m, Array2d<float>& out) {
  for (int row = 0; row < reference_.height; ++row) {
    place_row(row, depth_m);
    float* values = out.row(row);
    for (int i = 0; i < reference_.width; ++i)
      values[i] = column_[i] < 0 ? std::numeric_limits<float>::quiet_NaN()
                                 : static_cast<float>(luminance_.sample({column_[i], row_[i]}));
  }
}

}  // namespace skysweep::sweep
