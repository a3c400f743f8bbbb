// SPDX-License-Identifier: Apache-2.0
#include "report/color_error.h"

#include <cstdlib>
#include <limits>

#include "report/ortho_lattice.h"

namespace skysweep::report {
namespace {

// How often each difference of two bytes occurs: quantiles of any number of cells without keeping them.
class Differences {
 public:
  void add(int difference) {
    ++signed_[static_cast<std::size_t>(difference + 255)];
    ++absolute_[static_cast<std::size_t>(std::abs(difference))];
    ++count_;
  }
  ChannelError error() const {
    return {quantile(signed_, 0.5) - (count_ ? 255 : 0), quantile(absolute_, 0.5), quantile(absolute_, 0.95)};
  }

 private:
  // The smallest value that at least the share q of all does not exceed.
  template <std::size_t N>
  double quantile(const std::array<std::int64_t, N>& histogram, double q) const {
    std::int64_t below = 0;
    for (std::size_t value = 0; value < N; ++value) {
      below += histogram[value];
      if (below > 0 && static_cast<double>(below) >= q * static_cast<double>(count_)) return static_cast<double>(value);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::array<std::int64_t, 511> signed_{};
  std::array<std::int64_t, 256> absolute_{};
  std::int64_t count_ = 0;
};

}  // namespace

ColorError color_error(const raster::Raster<Rgba8>& ortho, const raster::Raster<Rgba8>& truth) {
  const CellOffset offset = lattice_offset(ortho.georeference, truth.georeference);
  ColorError out;
  std::array<Differences, 3> differences;
  for (int row = 0; row < truth.values.height(); ++row)
    for (int column = 0; column < truth.values.width(); ++column) {
      const Rgba8 b = truth.values(column, row);
      if (b.a == 0) continue;
      ++out.true_cells;
      const int x = column + offset.columns, y = row + offset.rows;
      if (!ortho.values.contains(x, y) || ortho.values(x, y).a == 0) continue;
      const Rgba8 a = ortho.values(x, y);
      ++out.cells;
      differences[0].add(a.r - b.r);
      differences[1].add(a.g - b.g);
      differences[2].add(a.b - b.b);
    }
  for (std::size_t i = 0; i < differences.size(); ++i) out.channels[i] = differences[i].error();
  return out;
}

}  // namespace skysweep::report
