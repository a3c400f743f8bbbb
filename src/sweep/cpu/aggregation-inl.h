// SPDX-License-Identifier: Apache-2.0
// From the luminance of several views to the matching cost of a segment of cells: see sweep/view_costs.h for the
// formulas. Included once for every instruction set (Highway's per-target idiom, hence the guard that toggles).
#if defined(SKYSWEEP_SWEEP_CPU_AGGREGATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYSWEEP_SWEEP_CPU_AGGREGATION_INL_H_
#undef SKYSWEEP_SWEEP_CPU_AGGREGATION_INL_H_
#else
#define SKYSWEEP_SWEEP_CPU_AGGREGATION_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <limits>

#include "sweep/cpu/lanes-inl.h"
#include "sweep/cpu/view_kernel.h"
#include "sweep/image_pyramid.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

// One row of kSegmentCells values for each view, or for each pair of views: (0, 1) (0, 2) ... (1, 2) ...
constexpr int kMaxPairs = kMaxViews * (kMaxViews - 1) / 2;
struct SegmentSamples {
  int count = 0;    // views that show any cell of the segment
  int levels = 0;   // window levels
  bool all = true;  // every view shows every cell
  alignas(64) std::array<float, kMaxWindowLevels * kMaxViews * kSegmentCells> luminance;
  alignas(64) std::array<float, kMaxViews * kSegmentCells> shown;  // 1 or 0

  float* luminance_of(int level, int view) { return luminance.data() + (level * kMaxViews + view) * kSegmentCells; }
  const float* luminance_of(int level, int view) const {
    return luminance.data() + (level * kMaxViews + view) * kSegmentCells;
  }
  const float* shown_by(int view) const { return shown.data() + view * kSegmentCells; }
};

// Sums over the window levels of |Y_i - Y_k| for every pair of views, zero where one of them does not show the cell;
// and of these over the other views for every view.
struct SegmentDifferences {
  alignas(64) std::array<float, kMaxPairs * kSegmentCells> pair;
  alignas(64) std::array<float, kMaxViews * kSegmentCells> view;
};

// As many levels as kLevels says, or as there are if it is 0.
template <int kLevels>
HWY_INLINE void take_differences_of(const SegmentSamples& samples, SegmentDifferences& out) {
  const F f;
  const int levels = kLevels > 0 ? kLevels : samples.levels;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    for (int k = 0; k < samples.count; ++k) hn::Store(hn::Zero(f), f, out.view.data() + k * kSegmentCells + i);
    float* HWY_RESTRICT pair = out.pair.data() + i;
    for (int k = 0; k + 1 < samples.count; ++k) {
      float* HWY_RESTRICT own = out.view.data() + k * kSegmentCells + i;
      VF total = hn::Load(f, own);
      for (int j = k + 1; j < samples.count; ++j, pair += kSegmentCells) {
        VF sum = hn::Zero(f);
        for (int level = 0; level < levels; ++level)
          sum = hn::Add(sum, hn::AbsDiff(hn::Load(f, samples.luminance_of(level, k) + i),
                                         hn::Load(f, samples.luminance_of(level, j) + i)));
        if (!samples.all)
          sum = hn::Mul(sum, hn::Mul(hn::Load(f, samples.shown_by(k) + i), hn::Load(f, samples.shown_by(j) + i)));
        hn::Store(sum, f, pair);
        float* other = out.view.data() + j * kSegmentCells + i;
        hn::Store(hn::Add(hn::Load(f, other), sum), f, other);
        total = hn::Add(total, sum);
      }
      hn::Store(total, f, own);
    }
  }
}

HWY_INLINE void take_differences(const SegmentSamples& samples, SegmentDifferences& out) {
  switch (samples.levels) {
    case 1: return take_differences_of<1>(samples, out);
    case 2: return take_differences_of<2>(samples, out);
    case 4: return take_differences_of<4>(samples, out);
    default: return take_differences_of<0>(samples, out);
  }
}

// The `wanted` smallest of `count` rows of values in every lane, in ascending order.
HWY_INLINE void smallest_first(float* HWY_RESTRICT values, int count, int wanted, int i) {
  const F f;
  for (int k = 0; k < wanted; ++k) {
    VF least = hn::Load(f, values + k * kSegmentCells + i);
    for (int j = k + 1; j < count; ++j) {
      float* other = values + j * kSegmentCells + i;
      const VF value = hn::Load(f, other);
      hn::Store(hn::Max(least, value), f, other);
      least = hn::Min(least, value);
    }
    hn::Store(least, f, values + k * kSegmentCells + i);
  }
}

// What the aggregation works with in one vector of cells, `i` cells into the segment.
struct Lanes {
  const SegmentSamples& samples;
  const SegmentDifferences& differences;
  int i;
  VF n;  // views that show the cell

  HWY_INLINE VF cost(int k) const { return hn::Load(F(), differences.view.data() + k * kSegmentCells + i); }
  HWY_INLINE VF shown(int k) const { return hn::Load(F(), samples.shown_by(k) + i); }

  // C_k in ascending order, those of views that do not show the cell last; `wanted` of them.
  HWY_INLINE void sort(int wanted, float* HWY_RESTRICT sorted) const {
    const F f;
    const VF infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    for (int k = 0; k < samples.count; ++k)
      hn::Store(hn::IfThenElse(hn::Eq(shown(k), hn::Zero(f)), infinity, cost(k)), f, sorted + k * kSegmentCells + i);
    smallest_first(sorted, samples.count, wanted, i);
  }
};

// The three ways to aggregate: sums over terms, the formulas of sweep/view_costs.h.
HWY_INLINE VF mean_of_all(const Lanes& lanes) {
  const F f;
  VF sum = hn::Zero(f);
  for (int k = 0; k < lanes.samples.count; ++k) sum = hn::Add(sum, lanes.cost(k));
  return hn::Div(sum, hn::Mul(lanes.n, hn::Sub(lanes.n, hn::Set(f, 1.0f))));
}

HWY_INLINE VF mean_of_better_half(const Lanes& lanes) {
  const F f;
  const VF one = hn::Set(f, 1.0f);
  alignas(64) std::array<float, kMaxViews * kSegmentCells> sorted;
  const int most = std::max(1, lanes.samples.count / 2);
  lanes.sort(most, sorted.data());
  const VF used = hn::Max(one, hn::Floor(hn::Mul(lanes.n, hn::Set(f, 0.5f))));
  VF sum = hn::Zero(f);
  for (int k = 0; k < most; ++k)
    sum = hn::Add(sum, hn::IfThenElseZero(hn::Lt(hn::Set(f, static_cast<float>(k)), used),
                                          hn::Load(f, sorted.data() + k * kSegmentCells + lanes.i)));
  return hn::Div(sum, hn::Mul(used, hn::Sub(lanes.n, one)));
}

HWY_INLINE VF mean_within_consensus(const Lanes& lanes, double share) {
  const F f;
  const int count = lanes.samples.count;
  const VF half = hn::Set(f, 0.5f), one = hn::Set(f, 1.0f);
  alignas(64) std::array<float, kMaxViews * kSegmentCells> sorted, weight;
  const int most = consensus_size(count, share);
  lanes.sort(std::min(most, count), sorted.data());
  const VF wanted = hn::Ceil(
      hn::MulAdd(hn::Set(f, static_cast<float>(share)), lanes.n, hn::Set(f, -static_cast<float>(kShareSlack))));
  const VF size = hn::Max(wanted, hn::Min(lanes.n, hn::Set(f, static_cast<float>(kSmallestConsensus))));
  VF limit = hn::Zero(f);
  for (int k = 0; k < std::min(most, count); ++k)
    limit = hn::IfThenElse(hn::Eq(size, hn::Set(f, static_cast<float>(k + 1))),
                           hn::Load(f, sorted.data() + k * kSegmentCells + lanes.i), limit);
  const VF least_reach =
      hn::Set(f, static_cast<float>(kConsensusSoftnessGrey * kLuminanceScale * lanes.samples.levels));
  const VF reach = hn::MulAdd(hn::Set(f, static_cast<float>(kConsensusSoftness)), limit,
                              hn::Mul(least_reach, hn::Sub(lanes.n, one)));
  const VF per_reach = hn::Div(one, reach);
  VF weights = hn::Zero(f), squares = hn::Zero(f);
  for (int k = 0; k < count; ++k) {
    const VF beyond = hn::Mul(hn::Sub(lanes.cost(k), limit), per_reach);
    const VF own = hn::Mul(lanes.shown(k), hn::Min(one, hn::Max(hn::Zero(f), hn::Sub(one, beyond))));
    hn::Store(own, f, weight.data() + k * kSegmentCells + lanes.i);
    weights = hn::Add(weights, own);
    squares = hn::MulAdd(own, own, squares);
  }
  VF sum = hn::Zero(f);
  const float* pair = lanes.differences.pair.data() + lanes.i;
  for (int k = 0; k + 1 < count; ++k) {
    const VF first = hn::Load(f, weight.data() + k * kSegmentCells + lanes.i);
    VF of_first = hn::Zero(f);
    for (int j = k + 1; j < count; ++j, pair += kSegmentCells)
      of_first = hn::MulAdd(hn::Load(f, pair), hn::Load(f, weight.data() + j * kSegmentCells + lanes.i), of_first);
    sum = hn::MulAdd(of_first, first, sum);
  }
  // The sum over the pairs of w_k w_j.
  return hn::Div(sum, hn::Mul(half, hn::Sub(hn::Mul(weights, weights), squares)));
}

// AC of every cell of a segment, grey levels.
HWY_INLINE void aggregate_segment(const SegmentSamples& samples, const SegmentDifferences& differences,
                                  const SweepOptions& options, float* HWY_RESTRICT out) {
  const F f;
  const VF penalty = hn::Set(f, static_cast<float>(options.few_views_penalty));
  const VF unit = hn::Set(f, static_cast<float>(1.0 / (samples.levels * kLuminanceScale)));
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    VF n = hn::Zero(f);
    for (int k = 0; k < samples.count; ++k) n = hn::Add(n, hn::Load(f, samples.shown_by(k) + i));
    const Lanes lanes{samples, differences, i, n};
    VF mean = hn::Zero(f);
    switch (options.aggregation) {
      case Aggregation::all_views: mean = mean_of_all(lanes); break;
      case Aggregation::better_half: mean = mean_of_better_half(lanes); break;
      case Aggregation::consensus: mean = mean_within_consensus(lanes, options.consensus_share); break;
    }
    const auto enough = hn::Ge(n, hn::Set(f, static_cast<float>(options.min_views)));
    const VF cost = hn::MulAdd(mean, unit, hn::Div(penalty, n));
    hn::Store(hn::IfThenElse(enough, cost, hn::Set(f, std::numeric_limits<float>::infinity())), f, out + i);
  }
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYSWEEP_SWEEP_CPU_AGGREGATION_INL_H_
