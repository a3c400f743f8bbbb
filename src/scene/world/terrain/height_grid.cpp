// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/height_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skysweep::scene {
namespace {

using Weights = std::array<double, 4>;

Weights catmull_rom(double t) {
  return {0.5 * t * (-1 + t * (2 - t)), 1 + 0.5 * t * t * (-5 + 3 * t), 0.5 * t * (1 + t * (4 - 3 * t)),
          0.5 * t * t * (t - 1)};
}

Weights catmull_rom_slope(double t) {
  return {0.5 * (-1 + t * (4 - 3 * t)), 0.5 * t * (-10 + 9 * t), 0.5 * (1 + t * (8 - 9 * t)), 0.5 * t * (-2 + 3 * t)};
}

constexpr double kWeightSum = 1.25;      // largest sum of the weights' absolute values (t = 1/2)
constexpr double kSlopeWeightSum = 3.0;  // the same of the weights' derivatives (t = 1/2)

// Bounds on the first and second derivative of the cubic between b and c.
struct CubicBounds {
  double least_slope, greatest_slope, bend;
};
CubicBounds bounds(double a, double b, double c, double d) {
  // The slope is a parabola: it lies within its Bezier points. The second derivative is a line between its ends.
  const std::array<double, 3> slope = {0.5 * (c - a), 3 * (c - b) - 0.5 * (c - a) - 0.5 * (d - b), 0.5 * (d - b)};
  const auto [least, greatest] = std::minmax_element(slope.begin(), slope.end());
  return {*least, *greatest, std::max(std::abs(2 * a - 5 * b + 4 * c - d), std::abs(-a + 4 * b - 5 * c + 2 * d))};
}

}  // namespace

HeightGrid::HeightGrid(const Array2d<double>& heights, Vec2d first, Vec2d spacing, Beyond beyond)
    : heights_(heights.width() + 2 * kRim, heights.height() + 2 * kRim),
      curvature_(heights_.width() - 1, heights_.height() - 1),
      first_(first - static_cast<double>(kRim) * spacing),
      spacing_(spacing) {
  for (int j = 0; j < heights_.height(); ++j)
    for (int i = 0; i < heights_.width(); ++i) {
      const int column = i - kRim, row = j - kRim;
      if (heights.contains(column, row))
        heights_(i, j) = heights(column, row);
      else if (beyond == Beyond::border)
        heights_(i, j) = heights(std::clamp(column, 0, heights.width() - 1), std::clamp(row, 0, heights.height() - 1));
    }
  // The outermost patches are flat across: `place` keeps within the others.
  range_ = {heights_(0, 0), heights_(0, 0)};
  for (int j = 1; j + 2 < heights_.height(); ++j)
    for (int i = 1; i + 2 < heights_.width(); ++i) {
      curvature_(i, j) = static_cast<float>(1.000001 * patch_curvature(i, j));
      double low = heights_(i, j), high = low;
      for (int y = -1; y <= 2; ++y)
        for (int x = -1; x <= 2; ++x) {
          low = std::min(low, heights_(i + x, j + y));
          high = std::max(high, heights_(i + x, j + y));
        }
      // Weights that add up to 1 and whose absolute values add up to at most w overshoot by (w - 1) / 2 of the range.
      const double overshoot = 0.5 * (kWeightSum * kWeightSum - 1) * (high - low);
      range_ = {std::min(range_.lowest, low - overshoot), std::max(range_.highest, high + overshoot)};
    }
}

HeightGrid::Place HeightGrid::place(double lattice_units, int count) const {
  const double first = 1, last = count - 2;  // beyond: constant
  if (lattice_units <= first) return {1, 0, true};
  if (lattice_units >= last) return {count - 3, 1, true};
  const int index = static_cast<int>(lattice_units);
  return {index, lattice_units - index, false};
}

HeightSample HeightGrid::at(Vec2d p) const {
  const Place x = place((p.x - first_.x) / spacing_.x, heights_.width());
  const Place y = place((p.y - first_.y) / spacing_.y, heights_.height());
  const Weights wx = catmull_rom(x.t), wy = catmull_rom(y.t);
  const Weights dx = catmull_rom_slope(x.t), dy = catmull_rom_slope(y.t);
  HeightSample out;
  for (int j = 0; j < 4; ++j) {
    const double* row = heights_.row(y.index - 1 + j) + x.index - 1;
    double z = 0, slope = 0;
    for (int i = 0; i < 4; ++i) {
      z += wx[static_cast<std::size_t>(i)] * row[i];
      slope += dx[static_cast<std::size_t>(i)] * row[i];
    }
    out.z += wy[static_cast<std::size_t>(j)] * z;
    out.slope.x += wy[static_cast<std::size_t>(j)] * slope;
    out.slope.y += dy[static_cast<std::size_t>(j)] * z;
  }
  out.slope = {x.beyond ? 0 : out.slope.x / spacing_.x, y.beyond ? 0 : out.slope.y / spacing_.y};
  return out;
}

HeightRange HeightGrid::heights(const Box2d&) const { return range_; }

MeshPlan HeightGrid::mesh_plan() const {
  MeshPlan plan;
  plan.spacing_m = 0.5 * std::min(spacing_.x, spacing_.y);
  return plan;
}

double HeightGrid::patch_curvature(int i, int j) const {
  double bend_x = 0, bend_y = 0;
  double least = 0, greatest = 0;  // slope in x over the four rows
  for (int k = -1; k <= 2; ++k) {
    const CubicBounds along =
        bounds(heights_(i - 1, j + k), heights_(i, j + k), heights_(i + 1, j + k), heights_(i + 2, j + k));
    const CubicBounds across =
        bounds(heights_(i + k, j - 1), heights_(i + k, j), heights_(i + k, j + 1), heights_(i + k, j + 2));
    bend_x = std::max(bend_x, along.bend);
    bend_y = std::max(bend_y, across.bend);
    least = k == -1 ? along.least_slope : std::min(least, along.least_slope);
    greatest = k == -1 ? along.greatest_slope : std::max(greatest, along.greatest_slope);
  }
  // The derivatives of the weights add up to 0: only differences between the rows count.
  const double twist = 0.5 * kSlopeWeightSum * (greatest - least) / (spacing_.x * spacing_.y);
  return std::max(kWeightSum * bend_x / (spacing_.x * spacing_.x), kWeightSum * bend_y / (spacing_.y * spacing_.y)) +
         twist;
}

double HeightGrid::curvature(const Box2d& box) const {
  const auto patch = [](double units, int count) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(units, 0., 1e9))), 1, count - 3);
  };
  // A patch that only touches the box has no part in it.
  constexpr double kTouch = 1e-9;
  const int west = patch((box.min.x - first_.x) / spacing_.x + kTouch, heights_.width());
  const int east = patch((box.max.x - first_.x) / spacing_.x - kTouch, heights_.width());
  const int south = patch((box.min.y - first_.y) / spacing_.y + kTouch, heights_.height());
  const int north = patch((box.max.y - first_.y) / spacing_.y - kTouch, heights_.height());
  float out = 0;
  for (int j = south; j <= north; ++j)
    for (int i = west; i <= east; ++i) out = std::max(out, curvature_(i, j));
  return out;
}

Box2d HeightGrid::extent() const {
  return {first_ + spacing_, first_ + Vec2d{(heights_.width() - 2) * spacing_.x, (heights_.height() - 2) * spacing_.y}};
}

}  // namespace skysweep::scene
