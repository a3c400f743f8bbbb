// SPDX-License-Identifier: Apache-2.0
#include "report/registration.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "report/ortho_lattice.h"
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

// Makes the values zero-mean and of unit length; false if they deviate less than `min_deviation` (no texture).
bool normalise(std::vector<float>& window, double min_deviation) {
  double sum = 0;
  for (const float value : window) sum += value;
  const double mean = sum / static_cast<double>(window.size());
  double squares = 0;
  for (float& value : window) {
    value -= static_cast<float>(mean);
    squares += static_cast<double>(value) * value;
  }
  if (squares < min_deviation * min_deviation * static_cast<double>(window.size())) return false;
  const auto scale = static_cast<float>(1 / std::sqrt(squares));
  for (float& value : window) value *= scale;
  return true;
}

// Position of the top of the parabola through three equidistant values, the middle one the largest.
double parabola_top(double before, double top, double after) {
  const double curvature = before - 2 * top + after;
  return curvature < 0 ? 0.5 * (before - after) / curvature : 0;
}

class BlockMatcher {
 public:
  BlockMatcher(const Array2d<float>& ortho, const Array2d<float>& truth, CellOffset offset,
               const RegistrationOptions& options)
      : ortho_(ortho), truth_(truth), offset_(offset), options_(options) {}

  // Shift of the block of the truth at (column, row), in columns and rows; nothing if it cannot be told.
  std::optional<Vec2d> shift(int column, int row) {
    const int side = options_.block_cells, reach = options_.search_cells;
    const int left = column + offset_.columns, top = row + offset_.rows;
    if (!ortho_.contains(left - reach, top - reach) ||
        !ortho_.contains(left + side - 1 + reach, top + side - 1 + reach))
      return std::nullopt;
    Array2d<double> correlation(2 * reach + 1, 2 * reach + 1);
    int best_x = 0, best_y = 0;
    for (int y = 0; y < correlation.height(); ++y)
      for (int x = 0; x < correlation.width(); ++x) {
        const std::optional<double> here = masked_correlation(column, row, left + x - reach, top + y - reach);
        if (!here) return std::nullopt;
        correlation(x, y) = *here;
        if (*here > correlation(best_x, best_y)) best_x = x, best_y = y;
      }
    const bool on_border = best_x == 0 || best_y == 0 || best_x == 2 * reach || best_y == 2 * reach;
    if (on_border || correlation(best_x, best_y) < options_.min_correlation) return std::nullopt;
    const double peak = correlation(best_x, best_y);
    return Vec2d{best_x - reach + parabola_top(correlation(best_x - 1, best_y), peak, correlation(best_x + 1, best_y)),
                 best_y - reach + parabola_top(correlation(best_x, best_y - 1), peak, correlation(best_x, best_y + 1))};
  }

 private:
  // Correlation of a block of the truth with one of the orthophoto over the cells that both have colours for, each
  // normalised over just these (Padfield 2012, IEEE TIP 21); nothing if these are too few or have no texture.
  std::optional<double> masked_correlation(int column, int row, int ortho_column, int ortho_row) {
    const int side = options_.block_cells;
    true_window_.clear();
    ortho_window_.clear();
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const float a = truth_(column + x, row + y), b = ortho_(ortho_column + x, ortho_row + y);
        if (a < 0 || b < 0) continue;
        true_window_.push_back(a);
        ortho_window_.push_back(b);
      }
    if (static_cast<double>(true_window_.size()) < options_.min_known_share * side * side) return std::nullopt;
    if (!normalise(true_window_, options_.min_deviation) || !normalise(ortho_window_, options_.min_deviation))
      return std::nullopt;
    double sum = 0;
    for (std::size_t i = 0; i < true_window_.size(); ++i)
      sum += static_cast<double>(true_window_[i]) * ortho_window_[i];
    return sum;
  }

  const Array2d<float>& ortho_;
  const Array2d<float>& truth_;
  const CellOffset offset_;
  const RegistrationOptions& options_;
  std::vector<float> true_window_, ortho_window_;  // kept, so that they are not allocated for every shift
};

void compare_colors(const Array2d<Rgba8>& ortho, const Array2d<Rgba8>& truth, CellOffset offset, Registration& out) {
  std::vector<float> differences;
  double sum = 0;
  for (int row = 0; row < truth.height(); ++row)
    for (int column = 0; column < truth.width(); ++column) {
      const int x = column + offset.columns, y = row + offset.rows;
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
  const CellOffset offset = lattice_offset(ortho.georeference, truth.georeference);
  const Array2d<float> ortho_luminance = luminance(ortho.values), truth_luminance = luminance(truth.values);
  BlockMatcher matcher(ortho_luminance, truth_luminance, offset, options);
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
