// SPDX-License-Identifier: Apache-2.0
#include "report/registration.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "raster/crs.h"
#include "report/quantile.h"

namespace skysweep::report {
namespace {

// Luminance of an orthophoto; negative where no colour is known.
Array2d<float> luminance(const Array2d<Rgba8>& image) {
  Array2d<float> out(image.width(), image.height(), -1.f);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Rgba8 c = image.data()[i];
    if (c.a > 0) out.data()[i] = 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
  }
  return out;
}

// A square window of an image as zero-mean values of unit length; nothing if it has holes or no texture.
std::optional<std::vector<float>> normalised_window(const Array2d<float>& image, int column, int row, int side,
                                                    double min_deviation) {
  std::vector<float> window;
  window.reserve(static_cast<std::size_t>(side) * side);
  double sum = 0;
  for (int y = row; y < row + side; ++y)
    for (int x = column; x < column + side; ++x) {
      if (image(x, y) < 0) return std::nullopt;
      window.push_back(image(x, y));
      sum += image(x, y);
    }
  const double mean = sum / static_cast<double>(window.size());
  double squares = 0;
  for (float& value : window) {
    value -= static_cast<float>(mean);
    squares += static_cast<double>(value) * value;
  }
  if (squares < min_deviation * min_deviation * static_cast<double>(window.size())) return std::nullopt;
  const auto scale = static_cast<float>(1 / std::sqrt(squares));
  for (float& value : window) value *= scale;
  return window;
}

// Position of the top of the parabola through three equidistant values, the middle one the largest.
double parabola_top(double before, double top, double after) {
  const double curvature = before - 2 * top + after;
  return curvature < 0 ? 0.5 * (before - after) / curvature : 0;
}

struct BlockMatcher {
  const Array2d<float>& ortho;
  const Array2d<float>& truth;
  Vec2d offset;  // truth column and row + offset = column and row of the orthophoto
  const RegistrationOptions& options;

  // Shift of the block of the truth at (column, row), in columns and rows; nothing if it cannot be told.
  std::optional<Vec2d> shift(int column, int row) const {
    const int side = options.block_cells, reach = options.search_cells;
    const auto block = normalised_window(truth, column, row, side, options.min_deviation);
    if (!block) return std::nullopt;
    const int left = column + static_cast<int>(offset.x), top = row + static_cast<int>(offset.y);
    if (!ortho.contains(left - reach, top - reach) || !ortho.contains(left + side - 1 + reach, top + side - 1 + reach))
      return std::nullopt;
    Array2d<double> correlation(2 * reach + 1, 2 * reach + 1);
    int best_x = 0, best_y = 0;
    for (int y = 0; y < correlation.height(); ++y)
      for (int x = 0; x < correlation.width(); ++x) {
        const auto other = normalised_window(ortho, left + x - reach, top + y - reach, side, options.min_deviation);
        if (!other) return std::nullopt;
        double sum = 0;
        for (std::size_t i = 0; i < block->size(); ++i) sum += static_cast<double>((*block)[i]) * (*other)[i];
        correlation(x, y) = sum;
        if (sum > correlation(best_x, best_y)) best_x = x, best_y = y;
      }
    const bool on_border = best_x == 0 || best_y == 0 || best_x == 2 * reach || best_y == 2 * reach;
    if (on_border || correlation(best_x, best_y) < options.min_correlation) return std::nullopt;
    const double peak = correlation(best_x, best_y);
    return Vec2d{best_x - reach + parabola_top(correlation(best_x - 1, best_y), peak, correlation(best_x + 1, best_y)),
                 best_y - reach + parabola_top(correlation(best_x, best_y - 1), peak, correlation(best_x, best_y + 1))};
  }
};

// Truth column and row + this = column and row of the orthophoto.
Vec2d lattice_offset(const raster::GeoReference& ortho, const raster::GeoReference& truth) {
  if (!raster::same_crs(ortho.crs_wkt, truth.crs_wkt))
    throw usage_error("the orthophoto is in " + raster::crs_name(ortho.crs_wkt) + " but the true one is in " +
                      raster::crs_name(truth.crs_wkt) + ": bring both into one system first");
  const Vec2d corners = truth.north_west_corner - ortho.north_west_corner;
  const Vec2d exact{corners.x / truth.cell_m, -corners.y / truth.cell_m};
  const Vec2d whole{std::round(exact.x), std::round(exact.y)};
  constexpr double kTolerance = 1e-3;
  if (std::abs(ortho.cell_m / truth.cell_m - 1) > 1e-9 || norm(exact - whole) > kTolerance)
    throw usage_error("the orthophoto and the true one lie on different grids: make both with the same cell");
  return whole;
}

void compare_colors(const Array2d<Rgba8>& ortho, const Array2d<Rgba8>& truth, Vec2d offset, Registration& out) {
  std::vector<float> differences;
  double sum = 0;
  for (int row = 0; row < truth.height(); ++row)
    for (int column = 0; column < truth.width(); ++column) {
      const int x = column + static_cast<int>(offset.x), y = row + static_cast<int>(offset.y);
      if (!ortho.contains(x, y) || ortho(x, y).a == 0 || truth(column, row).a == 0) continue;
      const Rgba8 a = ortho(x, y), b = truth(column, row);
      const float difference = static_cast<float>(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b)) / 3;
      differences.push_back(difference);
      sum += difference;
    }
  out.median_color_difference = quantile(differences, 0.5);
  out.mean_color_difference = sum / static_cast<double>(differences.size());  // NaN without cells
}

}  // namespace

Registration compare_orthophotos(const raster::Raster<Rgba8>& ortho, const raster::Raster<Rgba8>& truth,
                                 const RegistrationOptions& options) {
  const Vec2d offset = lattice_offset(ortho.georeference, truth.georeference);
  const Array2d<float> ortho_luminance = luminance(ortho.values), truth_luminance = luminance(truth.values);
  const BlockMatcher matcher{ortho_luminance, truth_luminance, offset, options};
  Registration out;
  std::vector<float> lengths, east, north;
  const int side = options.block_cells;
  for (int row = 0; row + side <= truth.values.height(); row += side)
    for (int column = 0; column + side <= truth.values.width(); column += side) {
      ++out.blocks;
      const std::optional<Vec2d> shift = matcher.shift(column, row);
      if (!shift) continue;
      ++out.blocks_used;
      lengths.push_back(static_cast<float>(norm(*shift)));
      east.push_back(static_cast<float>(shift->x));
      north.push_back(static_cast<float>(-shift->y));
    }
  out.median_shift_cells = quantile(lengths, 0.5);
  out.median_shift_x_cells = quantile(east, 0.5);
  out.median_shift_y_cells = quantile(north, 0.5);
  compare_colors(ortho.values, truth.values, offset, out);
  return out;
}

}  // namespace skysweep::report
