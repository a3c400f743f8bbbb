// SPDX-License-Identifier: Apache-2.0
// Bilinear luminance samples of a segment of cells.
// Included once for every instruction set (Highway's per-target idiom, hence the guard that toggles).
#if defined(SKYSWEEP_SWEEP_CPU_SAMPLING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYSWEEP_SWEEP_CPU_SAMPLING_INL_H_
#undef SKYSWEEP_SWEEP_CPU_SAMPLING_INL_H_
#else
#define SKYSWEEP_SWEEP_CPU_SAMPLING_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sweep/cpu/lanes-inl.h"
#include "sweep/cpu/positions-inl.h"
#include "sweep/cpu/view_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

// The four pixels around a sampling position, for each lane: in each half of the words the upper pixel lies low, the
// lower one high.
struct Quads {
  VI left, right;
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Quads load_quads(const std::uint32_t* HWY_RESTRICT pairs, const std::uint32_t* HWY_RESTRICT offsets) {
  std::array<std::int32_t, 2> quad;
  std::memcpy(quad.data(), pairs + offsets[0], sizeof quad);
  return {hn::Set(I(), quad[0]), hn::Set(I(), quad[1])};
}
#else
// kCount 64-bit words side by side. Loaded one by one: that takes half the time of the gathers of the machines measured
// (docs/performance.md).
template <int kCount>
HWY_INLINE auto load_words(const std::uint32_t* HWY_RESTRICT pairs, const std::uint32_t* HWY_RESTRICT offsets) {
  const hn::CappedTag<std::uint64_t, kCount> d;
  if constexpr (kCount == 1)
    return hn::LoadU(d, reinterpret_cast<const std::uint64_t*>(pairs + offsets[0]));
  else
    return hn::Combine(d, load_words<kCount / 2>(pairs, offsets + kCount / 2), load_words<kCount / 2>(pairs, offsets));
}

HWY_INLINE Quads load_quads(const std::uint32_t* HWY_RESTRICT pairs, const std::uint32_t* HWY_RESTRICT offsets) {
  const I i32;
  constexpr int kHalf = static_cast<int>(hn::MaxLanes(I())) / 2;
  const VI low = hn::BitCast(i32, load_words<kHalf>(pairs, offsets));
  const VI high = hn::BitCast(i32, load_words<kHalf>(pairs, offsets + kHalf));
  return {hn::ConcatEven(i32, high, low), hn::ConcatOdd(i32, high, low)};
}
#endif

HWY_INLINE VF upper_pixel(VI pair) { return hn::ConvertTo(F(), hn::And(pair, hn::Set(I(), 0xFFFF))); }
HWY_INLINE VF lower_pixel(VI pair) {
  return hn::ConvertTo(F(), hn::BitCast(I(), hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<F>(), pair))));
}

// A position along one axis at a mipmap level: whole part base + index, and the weight of the next pixel.
struct AxisLevel {
  int base;
  float remainder;
};
HWY_INLINE AxisLevel axis_at_level(int base, float scale) {
  const double at_level = base * static_cast<double>(scale) - 0.5;
  const double whole = std::floor(at_level);
  return {static_cast<int>(whole), static_cast<float>(at_level - whole)};
}

// Luminance of one view at one level for a whole segment, in stored units. Cells that are not shown read some pixel
// inside the array.
HWY_INLINE void sample_segment(const LevelKernel& level, const Positions& positions, float* HWY_RESTRICT out) {
  const F f;
  const I i32;
  const AxisLevel ax = axis_at_level(positions.base_u, level.scale), ay = axis_at_level(positions.base_v, level.scale);
  const VF scale = hn::Set(f, level.scale), remainder_x = hn::Set(f, ax.remainder),
           remainder_y = hn::Set(f, ay.remainder);
  const VI base_x = hn::Set(i32, ax.base), base_y = hn::Set(i32, ay.base), stride = hn::Set(i32, level.stride);
  const VI border = hn::Set(i32, -1), last_x = hn::Set(i32, level.width - 1), last_y = hn::Set(i32, level.height - 1);
  const VI origin = hn::Set(i32, level.stride + 1);  // element of pixel (0, 0), inside the border
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const VF x = hn::MulAdd(hn::Load(f, positions.u.data() + i), scale, remainder_x);
    const VF y = hn::MulAdd(hn::Load(f, positions.v.data() + i), scale, remainder_y);
    const VF whole_x = hn::Floor(x), whole_y = hn::Floor(y);
    const VF weight_x = hn::Sub(x, whole_x), weight_y = hn::Sub(y, whole_y);
    const VI column = hn::Min(hn::Max(hn::Add(hn::ConvertTo(i32, whole_x), base_x), border), last_x);
    const VI row = hn::Min(hn::Max(hn::Add(hn::ConvertTo(i32, whole_y), base_y), border), last_y);
    const VI offset = hn::Add(hn::Add(hn::Mul(row, stride), column), origin);
    alignas(64) std::array<std::uint32_t, kSegmentCells> offsets;
    const hn::RebindToUnsigned<I> u32;
    hn::Store(hn::BitCast(u32, offset), u32, offsets.data());
    const Quads quads = load_quads(level.pairs, reloaded(offsets.data()));
    const VF upper_left = upper_pixel(quads.left), lower_left = lower_pixel(quads.left);
    const VF a = hn::MulAdd(weight_x, hn::Sub(upper_pixel(quads.right), upper_left), upper_left);
    const VF b = hn::MulAdd(weight_x, hn::Sub(lower_pixel(quads.right), lower_left), lower_left);
    hn::Store(hn::MulAdd(weight_y, hn::Sub(b, a), a), f, out + i);
  }
}

// What a view's samples of a segment are compared as (sweep/luminance_gains.h).
HWY_INLINE void apply_gain(const ViewKernel& view, float* HWY_RESTRICT samples) {
  if (view.gain == 1) return;
  const F f;
  const VF gain = hn::Set(f, view.gain), offset = hn::Set(f, view.offset);
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f)))
    hn::Store(hn::MulAdd(hn::Load(f, samples + i), gain, offset), f, samples + i);
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYSWEEP_SWEEP_CPU_SAMPLING_INL_H_
