// SPDX-License-Identifier: Apache-2.0
// By how much the colours of an orthophoto differ from the true ones, channel by channel.
#pragma once

#include <array>
#include <cstdint>

#include "raster/geotiff.h"

namespace skysweep::report {

// Differences in 8-bit grey levels of the sRGB-encoded values, orthophoto minus truth.
struct ChannelError {
  double median = 0;           // of the signed differences: the tint
  double median_absolute = 0;  // NaN where no cell has both colours, here and in all others
  double p95_absolute = 0;     // 95 % quantile
};

struct ColorError {
  std::int64_t cells = 0;                  // with both colours
  std::int64_t true_cells = 0;             // with a true colour
  std::array<ChannelError, 3> channels{};  // red, green, blue
};

// Cell by cell; both on one lattice as for compare_orthophotos (report/registration.h).
ColorError color_error(const raster::Raster<Rgba8>& ortho, const raster::Raster<Rgba8>& truth);

}  // namespace skysweep::report
