// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target. Whole numbers: the same on each of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/similar_normalization.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Adds the pixels of one offset to the sums of those like the middle ones; squares in 1/16 grey level. Reads and writes
// whole vectors: all arrays reach as far beyond `width`.
void add_similar(const std::uint16_t* HWY_RESTRICT middle, const std::uint16_t* HWY_RESTRICT other, int width,
                 int tolerance, std::int32_t* HWY_RESTRICT counts, std::int32_t* HWY_RESTRICT sums,
                 std::int32_t* HWY_RESTRICT squares) {
  const hn::CappedTag<std::int32_t, 16> d;
  const hn::Rebind<std::uint16_t, decltype(d)> narrow;
  const auto limit = hn::Set(d, tolerance + 1), one = hn::Set(d, 1);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const auto difference =
        hn::Sub(hn::PromoteTo(d, hn::LoadU(narrow, other + x)), hn::PromoteTo(d, hn::LoadU(narrow, middle + x)));
    const auto similar = hn::Gt(limit, hn::Abs(difference));
    const auto coarse = hn::ShiftRight<4>(difference);
    hn::StoreU(hn::Add(hn::LoadU(d, counts + x), hn::IfThenElseZero(similar, one)), d, counts + x);
    hn::StoreU(hn::Add(hn::LoadU(d, sums + x), hn::IfThenElseZero(similar, difference)), d, sums + x);
    hn::StoreU(hn::Add(hn::LoadU(d, squares + x), hn::IfThenElseZero(similar, hn::Mul(coarse, coarse))), d,
               squares + x);
  }
}

}  // namespace skysweep::sweep::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <vector>

#include "core/check.h"
#include "sweep/local_normalization.h"
#include "sweep/similar_normalization.h"

namespace skysweep::sweep {

HWY_EXPORT(add_similar);

namespace {

constexpr int kSlack = 16;  // a whole vector of the widest instruction set

// The image with its border pixels repeated `radius` times on every side.
Array2d<std::uint16_t> padded(const Array2d<std::uint16_t>& image, int radius) {
  Array2d<std::uint16_t> out(image.width() + 2 * radius + kSlack, image.height() + 2 * radius);
  for (int y = 0; y < out.height(); ++y) {
    const std::uint16_t* from = image.row(std::clamp(y - radius, 0, image.height() - 1));
    std::uint16_t* to = out.row(y);
    std::fill_n(to, radius, from[0]);
    std::copy_n(from, image.width(), to + radius);
    std::fill(to + radius + image.width(), to + out.width(), from[image.width() - 1]);
  }
  return out;
}

}  // namespace

void normalize_similar(Array2d<std::uint16_t>& luminance, int radius_px, int tolerance) {
  SKY_CHECK(radius_px > 0 && radius_px <= kLargestSimilarRadius && tolerance > 0);
  const int width = luminance.width();
  const Array2d<std::uint16_t> source = padded(luminance, radius_px);
  std::vector<std::int32_t> counts(width + kSlack), sums(width + kSlack), squares(width + kSlack);
  for (int y = 0; y < luminance.height(); ++y) {
    for (auto* values : {&counts, &sums, &squares}) std::fill(values->begin(), values->end(), 0);
    for (int dy = -radius_px; dy <= radius_px; ++dy)
      for (int dx = -radius_px; dx <= radius_px; ++dx) HWY_DYNAMIC_DISPATCH(add_similar)
    (source.row(y + radius_px) + radius_px, source.row(y + radius_px + dy) + radius_px + dx, width, tolerance,
     counts.data(), sums.data(), squares.data());
    for (int x = 0; x < width; ++x) {
      const double mean = static_cast<double>(sums[x]) / counts[x];  // above the middle pixel, which is 0 here
      luminance(x, y) = normalized(0, mean, 256.0 * squares[x] / counts[x] - mean * mean);
    }
  }
}

}  // namespace skysweep::sweep
#endif  // HWY_ONCE
