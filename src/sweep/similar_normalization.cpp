// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target. The same on each of them: whole numbers, then
// the roundings of IEEE 754.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/similar_normalization.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "sweep/image_pyramid.h"
#include "sweep/local_normalization.h"

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

// `normalized` of a whole row of middle pixels, rounding for rounding.
void normalize_row(const std::int32_t* HWY_RESTRICT counts, const std::int32_t* HWY_RESTRICT sums,
                   const std::int32_t* HWY_RESTRICT squares, int width, std::uint16_t* HWY_RESTRICT out) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<std::int32_t, decltype(d)> i32;
  const hn::Rebind<std::uint16_t, decltype(d)> u16;
  constexpr double kFloor = kNoiseFloor * kNoiseFloor * kLuminanceScale * kLuminanceScale;
  const auto zero = hn::Zero(d);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const auto count = hn::PromoteTo(d, hn::LoadU(i32, counts + x));
    const auto mean = hn::Div(hn::PromoteTo(d, hn::LoadU(i32, sums + x)), count);
    const auto square = hn::Mul(hn::Set(d, 256.0), hn::PromoteTo(d, hn::LoadU(i32, squares + x)));
    const auto variance = hn::Sub(hn::Div(square, count), hn::Mul(mean, mean));
    const auto deviation = hn::Sqrt(hn::Add(hn::Max(zero, variance), hn::Set(d, kFloor)));
    const auto scaled = hn::Div(hn::Mul(hn::Set(d, kNormalizedDeviation), hn::Sub(zero, mean)), deviation);
    const auto grey = hn::Min(hn::Max(hn::Add(hn::Set(d, kNormalizedMean), scaled), zero), hn::Set(d, 255.0));
    const auto stored = hn::Add(hn::Mul(grey, hn::Set(d, kLuminanceScale)), hn::Set(d, 0.5));
    hn::StoreU(hn::DemoteTo(u16, hn::DemoteTo(i32, stored)), u16, out + x);
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
HWY_EXPORT(normalize_row);

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
  std::vector<std::uint16_t> normalized_row(width + kSlack);
  for (int y = 0; y < luminance.height(); ++y) {
    for (auto* values : {&counts, &sums, &squares}) std::fill(values->begin(), values->end(), 0);
    for (int dy = -radius_px; dy <= radius_px; ++dy)
      for (int dx = -radius_px; dx <= radius_px; ++dx) HWY_DYNAMIC_DISPATCH(add_similar)
    (source.row(y + radius_px) + radius_px, source.row(y + radius_px + dy) + radius_px + dx, width, tolerance,
     counts.data(), sums.data(), squares.data());
    HWY_DYNAMIC_DISPATCH(normalize_row)(counts.data(), sums.data(), squares.data(), width, normalized_row.data());
    std::copy_n(normalized_row.begin(), width, luminance.row(y));
  }
}

}  // namespace skysweep::sweep
#endif  // HWY_ONCE
