// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target; dispatched once per block of cells.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/cpu/patches_cpu.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sweep/cpu/patches_cpu.h"
#include "sweep/cpu/positions-inl.h"
#include "sweep/cpu/sampling-inl.h"
#include "sweep/cpu/view_kernel.h"
#include "sweep/patch_costs.h"

#ifndef SKYSWEEP_SWEEP_CPU_PATCHES_CPU_ONCE_
#define SKYSWEEP_SWEEP_CPU_PATCHES_CPU_ONCE_
namespace skysweep::sweep::cpu {

constexpr int kRegionSide = kBlockCells + 2 * kMostPatchReach;  // two segments
constexpr int kRegionCells = kRegionSide * kRegionSide;
constexpr int kBlockSize = kBlockCells * kBlockCells;
static_assert(kRegionSide == 2 * kSegmentCells);

struct BlockJob {
  const SweepProblem* problem = nullptr;
  const std::vector<ViewKernel>* views = nullptr;
  int column = 0, row = 0;                // of the block's first cell
  const float* lowest_visible = nullptr;  // kBlockSize for each view; null: views see everything
};

// Scratch of a row of blocks.
struct PatchWorkspace {
  explicit PatchWorkspace(const SweepProblem& problem)
      : levels(problem.options.window_level_max - problem.options.window_level_min + 1),
        points((2 * problem.options.patch_radius_cells + 1) * (2 * problem.options.patch_radius_cells + 1)),
        regions(hwy::AllocateAligned<float>(problem.views.size() * levels * kRegionCells)),
        shown(problem.views.size() * kBlockSize),
        descriptors(problem.views.size() * levels * points * kSegmentCells),
        sum(static_cast<std::size_t>(levels) * points * kSegmentCells) {}

  float* region(int view, int level) { return regions.get() + (view * levels + level) * kRegionCells; }
  float* shown_by(int view) { return shown.data() + view * kBlockSize; }
  float* descriptor(int view) { return descriptors.data() + view * levels * points * kSegmentCells; }

  int levels, points;
  int count = 0;                               // views that show any patch of the block
  hwy::AlignedFreeUniquePtr<float[]> regions;  // luminance of block and surroundings, of each view and level
  std::vector<float> shown;                    // 1 or 0 for each view and cell of the block
  std::vector<float> descriptors;              // of one row of the block's cells
  std::vector<float> sum;                      // of the views' descriptors
  std::array<float, kRegionCells> region_shown, shown_across;
  std::array<float, kBlockSize> shown_before;  // views that show the cell's patch, hidden or not
  std::array<float, kBlockSize> costs;
};

}  // namespace skysweep::sweep::cpu
#endif

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

// Samples the rows of block and surroundings that one view shows at height z; returns whether it shows any cell there.
bool sample_region(const BlockJob& job, const ViewKernel& view, double z, float* regions, PatchWorkspace& work,
                   bool& all) {
  const SweepProblem& problem = *job.problem;
  const SweepOptions& options = problem.options;
  const int reach = patch_reach(options);
  bool any = false;
  Knots knots;
  Positions positions;
  for (int r = kMostPatchReach - reach; r < kRegionSide - kMostPatchReach + reach; ++r) {
    const int from_block = std::max({kMostPatchReach - r, r - (kRegionSide - kMostPatchReach - 1), 0});
    const Vec2d first = problem.grid.cell_center(job.column - kMostPatchReach, job.row - kMostPatchReach + r);
    project_knots(view, first, problem.grid.cell_m, z, knots);
    for (int segment = 0; segment < 2; ++segment) {
      const int at = r * kRegionSide + segment * kSegmentCells;
      bool shown = false, segment_all = true;
      Segment u, v;
      if (polynomial_through(knots.u.data() + segment, u) && polynomial_through(knots.v.data() + segment, v)) {
        shown = positions_of(view, u, v, positions, segment_all);
      } else {
        shown = positions_one_by_one(view, {first.x + segment * kSegmentCells * problem.grid.cell_m, first.y},
                                     problem.grid.cell_m, z, positions);
        segment_all = false;
      }
      all = all && shown && segment_all;
      if (!shown) {
        std::fill_n(work.region_shown.begin() + at, kSegmentCells, 0.0f);
        for (int level = 0; level < work.levels; ++level)
          std::fill_n(regions + level * kRegionCells + at, kSegmentCells, 0.0f);
        continue;
      }
      any = true;
      std::copy(positions.shown.begin(), positions.shown.end(), work.region_shown.begin() + at);
      for (int level = 0; level < work.levels; ++level)
        if (from_block <= options.patch_radius_cells << (options.window_level_min + level))
          sample_segment(view.levels[level], positions, regions + level * kRegionCells + at);
    }
  }
  return any;
}

// The cells of the block all of whose surroundings within `reach` are shown.
void shrink_shown(int reach, PatchWorkspace& work, float* shown) {
  for (int r = kMostPatchReach - reach; r < kRegionSide - kMostPatchReach + reach; ++r) {
    const float* row = work.region_shown.data() + r * kRegionSide + kMostPatchReach;
    for (int x = 0; x < kBlockCells; ++x)
      work.shown_across[r * kRegionSide + x] = *std::min_element(row + x - reach, row + x + reach + 1);
  }
  for (int y = 0; y < kBlockCells; ++y)
    for (int x = 0; x < kBlockCells; ++x) {
      float least = 1;
      for (int r = y - reach; r <= y + reach; ++r)
        least = std::min(least, work.shown_across[(r + kMostPatchReach) * kRegionSide + x]);
      shown[y * kBlockCells + x] = least;
    }
}

// Samples all views that show patches of the block at height z.
void sample_views(const BlockJob& job, double z, PatchWorkspace& work) {
  work.count = 0;
  work.shown_before.fill(0);
  for (std::size_t v = 0; v < job.views->size(); ++v) {
    bool all = true;
    if (!sample_region(job, (*job.views)[v], z, work.region(work.count, 0), work, all)) continue;
    float* shown = work.shown_by(work.count);
    if (all)
      std::fill_n(shown, kBlockSize, 1.0f);
    else
      shrink_shown(patch_reach(job.problem->options), work, shown);
    bool any = false;
    for (int i = 0; i < kBlockSize; ++i) {
      work.shown_before[i] += shown[i];
      if (job.lowest_visible && static_cast<float>(z) < job.lowest_visible[v * kBlockSize + i]) shown[i] = 0;
      any = any || shown[i] != 0;
    }
    if (any) ++work.count;
  }
}

// The descriptor of the patches of one vector of cells, at `middle` of a region; returns its squared length.
HWY_INLINE VF describe(const SweepOptions& options, int level, int levels, const float* middle, VF shown,
                       float* HWY_RESTRICT out) {
  const F f;
  const int radius = options.patch_radius_cells, step = 1 << (options.window_level_min + level);
  const int points = (2 * radius + 1) * (2 * radius + 1);
  VF sum = hn::Zero(f), squares = hn::Zero(f);
  const auto for_each_point = [&](auto visit) {
    int j = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx, ++j) visit(j, hn::LoadU(f, middle + (dy * kRegionSide + dx) * step));
  };
  if (options.cost == MatchingCost::census) {
    const VF center = hn::LoadU(f, middle), one = hn::Set(f, 1.0f), least = hn::Set(f, -1.0f);
    const VF scale = hn::Set(f, static_cast<float>(1 / (kCensusRamp * kLuminanceScale)));
    const VF weight = hn::Mul(shown, hn::Set(f, static_cast<float>(1 / std::sqrt((points - 1.0) * levels))));
    for_each_point([&](int j, VF x) {
      const VF sign = hn::Min(one, hn::Max(least, hn::Mul(hn::Sub(x, center), scale)));
      const VF own = hn::Mul(sign, weight);
      hn::StoreU(own, f, out + j * kSegmentCells);
      squares = hn::MulAdd(own, own, squares);
    });
    return squares;
  }
  for_each_point([&](int, VF x) { sum = hn::Add(sum, x); });
  const VF mean = hn::Mul(sum, hn::Set(f, static_cast<float>(1.0 / points)));
  for_each_point([&](int, VF x) {
    const VF own = hn::Sub(x, mean);
    squares = hn::MulAdd(own, own, squares);
  });
  const VF floor =
      hn::Set(f, static_cast<float>(points * kPatchFloor * kPatchFloor * kLuminanceScale * kLuminanceScale));
  const VF length = hn::Sqrt(hn::Mul(hn::Add(squares, floor), hn::Set(f, static_cast<float>(levels))));
  const VF weight = hn::Div(shown, length);
  for_each_point([&](int j, VF x) { hn::StoreU(hn::Mul(hn::Sub(x, mean), weight), f, out + j * kSegmentCells); });
  return hn::Mul(squares, hn::Mul(weight, weight));
}

// What the views of one vector of cells differ by, before it becomes a cost: see sweep/patch_costs.h.
struct LaneCosts {
  alignas(64) std::array<float, kMaxViews * kSegmentCells> length, cost, shown;  // q_k, C_k in grey levels, 1 or 0
};

HWY_INLINE VF row_of(const std::array<float, kMaxViews * kSegmentCells>& rows, int k) {
  return hn::Load(F(), rows.data() + k * kSegmentCells);
}

// C_k in ascending order, `wanted` of them; those of views that do not show the cell last.
using Rows = std::array<float, kMaxViews * kSegmentCells>;
HWY_INLINE void sort_costs(const LaneCosts& lanes, int count, int wanted, Rows& sorted) {
  const F f;
  const VF infinity = hn::Set(f, std::numeric_limits<float>::infinity());
  for (int k = 0; k < count; ++k)
    hn::Store(hn::IfThenElse(hn::Eq(row_of(lanes.shown, k), hn::Zero(f)), infinity, row_of(lanes.cost, k)), f,
              sorted.data() + k * kSegmentCells);
  for (int pass = 0; pass < wanted; ++pass)
    for (int k = count - 1; k > pass; --k) {
      float* lower = sorted.data() + (k - 1) * kSegmentCells;
      const VF a = hn::Load(f, lower), b = hn::Load(f, lower + kSegmentCells);
      hn::Store(hn::Min(a, b), f, lower);
      hn::Store(hn::Max(a, b), f, lower + kSegmentCells);
    }
}

// Mean of the lowest C_k, `used` of them.
HWY_INLINE VF mean_of_smallest(const LaneCosts& lanes, int count, VF used) {
  const F f;
  alignas(64) Rows sorted;
  sort_costs(lanes, count, count, sorted);
  VF sum = hn::Zero(f);
  for (int k = 0; k < count; ++k)
    sum = hn::Add(sum, hn::IfThenElseZero(hn::Lt(hn::Set(f, static_cast<float>(k)), used), row_of(sorted, k)));
  return hn::Div(sum, used);
}

// The m-th lowest C_k, m = consensus_size of the views that show the cell.
HWY_INLINE VF consensus_limit(const LaneCosts& lanes, int count, VF n, double share) {
  const F f;
  const VF wanted =
      hn::Ceil(hn::MulAdd(hn::Set(f, static_cast<float>(share)), n, hn::Set(f, -static_cast<float>(kShareSlack))));
  const VF size = hn::Max(wanted, hn::Min(n, hn::Set(f, static_cast<float>(kSmallestConsensus))));
  alignas(64) Rows sorted;
  const int most = std::min(count, consensus_size(count, share));
  sort_costs(lanes, count, most, sorted);
  VF limit = hn::Zero(f);
  for (int k = 0; k < most; ++k)
    limit = hn::IfThenElse(hn::Eq(size, hn::Set(f, static_cast<float>(k + 1))), row_of(sorted, k), limit);
  return limit;
}

// Mean difference of the pairs, weighted by how near their C_k are to the limit; grey levels.
HWY_INLINE VF difference_within(const LaneCosts& lanes, VF limit, PatchWorkspace& work) {
  const F f;
  const VF one = hn::Set(f, 1.0f);
  const VF per_reach = hn::Div(one, hn::MulAdd(hn::Set(f, static_cast<float>(kConsensusSoftness)), limit,
                                               hn::Set(f, static_cast<float>(kConsensusSoftnessGrey))));
  alignas(64) std::array<float, kMaxViews * kSegmentCells> weights;
  VF total = hn::Zero(f), squares = hn::Zero(f), lengths = hn::Zero(f);
  for (int k = 0; k < work.count; ++k) {
    const VF beyond = hn::Mul(hn::Sub(row_of(lanes.cost, k), limit), per_reach);
    const VF own = hn::Mul(row_of(lanes.shown, k), hn::Min(one, hn::Max(hn::Zero(f), hn::Sub(one, beyond))));
    hn::Store(own, f, weights.data() + k * kSegmentCells);
    total = hn::Add(total, own);
    squares = hn::MulAdd(own, own, squares);
    lengths = hn::MulAdd(own, row_of(lanes.length, k), lengths);
  }
  VF sum_squared = hn::Zero(f);
  for (int j = 0; j < work.levels * work.points; ++j) {
    VF sum = hn::Zero(f);
    for (int k = 0; k < work.count; ++k)
      sum = hn::MulAdd(row_of(weights, k), hn::LoadU(f, work.descriptor(k) + j * kSegmentCells), sum);
    sum_squared = hn::MulAdd(sum, sum, sum_squared);
  }
  const VF pairs = hn::Sub(hn::Mul(total, total), squares);
  return hn::Mul(hn::Set(f, static_cast<float>(kPatchCostGrey)),
                 hn::Div(hn::Sub(hn::Mul(total, lengths), sum_squared), pairs));
}

// Costs of the cells i to i + lanes of a row of the block, into work.costs.
HWY_INLINE void row_costs(const BlockJob& job, int y, int i, LaneCosts& lanes, PatchWorkspace& work) {
  const F f;
  const SweepOptions& options = job.problem->options;
  const int floats = work.levels * work.points * kSegmentCells, cell = y * kBlockCells + i;
  const int at = (y + kMostPatchReach) * kRegionSide + kMostPatchReach + i;
  std::fill(work.sum.begin(), work.sum.end(), 0.0f);
  VF n = hn::Zero(f), all_lengths = hn::Zero(f);
  for (int k = 0; k < work.count; ++k) {
    const VF shown = hn::LoadU(f, work.shown_by(k) + cell);
    float* descriptor = work.descriptor(k);
    VF length = hn::Zero(f);
    for (int level = 0; level < work.levels; ++level)
      length = hn::Add(length, describe(options, level, work.levels, work.region(k, level) + at, shown,
                                        descriptor + level * work.points * kSegmentCells));
    for (int j = 0; j < floats; j += kSegmentCells)
      hn::StoreU(hn::Add(hn::LoadU(f, work.sum.data() + j), hn::LoadU(f, descriptor + j)), f, work.sum.data() + j);
    hn::Store(shown, f, lanes.shown.data() + k * kSegmentCells);
    hn::Store(length, f, lanes.length.data() + k * kSegmentCells);
    n = hn::Add(n, shown);
    all_lengths = hn::Add(all_lengths, length);
  }
  const VF one = hn::Set(f, 1.0f), half = hn::Set(f, 0.5f);
  const VF per_other = hn::Div(hn::Set(f, static_cast<float>(kPatchCostGrey / 2)), hn::Max(one, hn::Sub(n, one)));
  for (int k = 0; k < work.count; ++k) {
    VF with_sum = hn::Zero(f);
    for (int j = 0; j < floats; j += kSegmentCells)
      with_sum = hn::MulAdd(hn::LoadU(f, work.descriptor(k) + j), hn::LoadU(f, work.sum.data() + j), with_sum);
    const VF difference = hn::Sub(hn::MulAdd(n, row_of(lanes.length, k), all_lengths), hn::Add(with_sum, with_sum));
    hn::Store(hn::Mul(difference, per_other), f, lanes.cost.data() + k * kSegmentCells);
  }
  VF cost = hn::Zero(f);
  switch (options.aggregation) {
    case Aggregation::all_views: cost = mean_of_smallest(lanes, work.count, n); break;
    case Aggregation::better_half:
      cost = mean_of_smallest(lanes, work.count, hn::Max(one, hn::Floor(hn::Mul(n, half))));
      break;
    case Aggregation::consensus:
      cost = difference_within(lanes, consensus_limit(lanes, work.count, n, options.consensus_share), work);
      break;
  }
  cost = hn::Add(cost, hn::Div(hn::Set(f, static_cast<float>(options.few_views_penalty)), n));
  const VF min_views = hn::Set(f, static_cast<float>(options.min_views));
  const VF infinity = hn::Set(f, std::numeric_limits<float>::infinity());
  const auto hidden = hn::Ge(hn::LoadU(f, work.shown_before.data() + cell), min_views);
  const VF none = job.lowest_visible
                      ? hn::IfThenElse(hidden, hn::Set(f, static_cast<float>(options.hidden_cost)), infinity)
                      : infinity;
  hn::StoreU(hn::IfThenElse(hn::Ge(n, min_views), cost, none), f, work.costs.data() + cell);
}

// Costs of all cells of a block at plane k, into work.costs.
void block_costs(const BlockJob& job, int k, PatchWorkspace& work) {
  sample_views(job, k * job.problem->dz_m, work);
  LaneCosts lanes;
  for (int y = 0; y < kBlockCells; ++y)
    for (int i = 0; i < kBlockCells; i += static_cast<int>(hn::Lanes(F()))) row_costs(job, y, i, lanes, work);
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skysweep::sweep::cpu {

HWY_EXPORT(block_costs);

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Whether anything is hidden from any view in a block; and from where on the views see its cells.
bool hides_from_block(const SweepProblem& problem, int column, int row, std::vector<float>& lowest_visible) {
  if (!problem.visibility.any()) return false;
  bool hides = false;
  lowest_visible.assign(problem.views.size() * kBlockSize, -kInfinity);
  for (std::size_t v = 0; v < problem.views.size(); ++v)
    for (int y = 0; y < kBlockCells && row + y < problem.grid.height; ++y)
      for (int x = 0; x < kBlockCells && column + x < problem.grid.width; ++x) {
        const float lowest = problem.visibility.lowest_visible(static_cast<int>(v), column + x, row + y);
        lowest_visible[v * kBlockSize + y * kBlockCells + x] = lowest;
        hides = hides || lowest > -kInfinity;
      }
  return hides;
}

// Calls take(block, column, row, cell of the block, range, k, cost) for every cell and plane of every block, planes in
// ascending order; `block` is what begin_block() gave for it.
template <typename Begin, typename Take>
void for_each_cost(const SweepProblem& problem, Executor& executor, Begin begin_block, Take take) {
  if (problem.views.empty()) return;
  std::vector<ViewKernel> views;
  for (const View& view : problem.views) views.push_back(make_view_kernel(view, problem.options));
  executor.parallel_for(blocks_across(problem.grid.height), [&](int by) {
    PatchWorkspace work(problem);
    std::vector<float> lowest_visible;
    for (int bx = 0; bx < blocks_across(problem.grid.width); ++bx) {
      BlockJob job{&problem, &views, bx * kBlockCells, by * kBlockCells, nullptr};
      const PlaneSet& planes = problem.block_planes(bx, by);
      if (planes.empty()) continue;
      if (hides_from_block(problem, job.column, job.row, lowest_visible)) job.lowest_visible = lowest_visible.data();
      auto block = begin_block();
      const int width = std::min(kBlockCells, problem.grid.width - job.column);
      const int height = std::min(kBlockCells, problem.grid.height - job.row);
      for_each_stored_range(planes, [&](StoredRange range) {
        for (int k = range.planes.first; k <= range.planes.last; ++k) {
          HWY_DYNAMIC_DISPATCH(block_costs)(job, k, work);
          for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
              take(block, job.column + x, job.row + y, y * kBlockCells + x, range, k, work.costs[y * kBlockCells + x]);
        }
      });
    }
  });
}

// What is known of the cells of a block while planes ascend.
struct Winner {
  float best = kInfinity, below = kInfinity, above = kInfinity, previous = kInfinity, sum = 0;
  int seen = 0, plane = 0, previous_plane = std::numeric_limits<int>::min();

  void take(int k, float cost) {
    const float before = previous_plane == k - 1 ? previous : kInfinity;
    if (seen > 0 && plane == k - 1) above = cost;
    if (cost < best) {
      best = cost, below = before, above = kInfinity;
      plane = k;
    }
    if (cost < kInfinity) sum += cost, ++seen;
    previous = cost;
    previous_plane = k;
  }
};

}  // namespace

CostVolume match_patch_costs(const SweepProblem& problem, Executor& executor) {
  CostVolume costs(problem, kWorstCost);
  for_each_cost(
      problem, executor, [] { return 0; },
      [&](int, int column, int row, int, StoredRange range, int k, float cost) {
        costs.cell(column, row)[range.slot + k - range.planes.first] = quantized_cost(cost);
      });
  return costs;
}

MatchResult match_patches_cell_by_cell(const SweepProblem& problem, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  for_each_cost(
      problem, executor, [] { return std::vector<Winner>(kBlockSize); },
      [&](std::vector<Winner>& winners, int column, int row, int cell, StoredRange, int k, float cost) {
        Winner& winner = winners[cell];
        winner.take(k, cost);
        if (winner.seen == 0) return;
        const Parabola parabola = parabola_through(winner.below, winner.best, winner.above);
        result.plane(column, row) = winner.plane;
        result.cost(column, row) = winner.best;
        result.mean_cost(column, row) = winner.sum / static_cast<float>(winner.seen);
        result.fraction(column, row) = static_cast<float>(parabola.vertex);
        result.bend(column, row) = static_cast<float>(parabola.bend);
      });
  return result;
}

}  // namespace skysweep::sweep::cpu
#endif  // HWY_ONCE
