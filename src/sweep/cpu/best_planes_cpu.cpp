// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/cpu/best_planes_cpu.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <climits>
#include <cstdint>

#include "sweep/best_planes.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using C = hn::CappedTag<Cost, kVolumeLanes>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(C()));

// Calls visit(range, first plane's place in it, lanes that hold its planes) for every vector of the cell's planes.
template <typename Visit>
HWY_INLINE void for_each_vector(const PlaneSet& planes, Visit visit) {
  int slot = 0;
  for (const PlaneRange& range : planes.ranges()) {
    const int count = range.count();
    for (int i = 0; i < count; i += kLanes)
      visit(StoredRange{range, slot}, i, hn::FirstN(C(), static_cast<std::size_t>(count - i)));
    slot += padded_planes(range);
  }
}

HWY_INLINE void find_least(const CellValues& cell, PlaneWinner& winner) {
  const C d;
  const auto beyond = hn::Set(d, kBeyondRange);
  auto least = beyond;
  for_each_vector(*cell.planes, [&](StoredRange range, int i, auto stored) HWY_ATTR {
    least = hn::Min(least, hn::IfThenElse(stored, hn::LoadU(d, cell.sums + range.slot + i), beyond));
  });
  winner.sum = hn::GetLane(hn::MinOfLanes(d, least));
  bool found = false;
  for_each_vector(*cell.planes, [&](StoredRange range, int i, auto stored) HWY_ATTR {
    if (found) return;
    const auto equal = hn::And(stored, hn::Eq(hn::LoadU(d, cell.sums + range.slot + i), hn::Set(d, winner.sum)));
    const std::intptr_t lane = hn::FindFirstTrue(d, equal);
    if (lane < 0) return;
    found = true;
    const int at = i + static_cast<int>(lane);
    winner.plane = range.planes.first + at;
    winner.slot = range.slot + at;
    winner.has_neighbours = at > 0 && at < range.planes.count() - 1;
  });
}

HWY_INLINE void find_rival(const CellValues& cell, PlaneWinner& winner) {
  const C d;
  const auto beyond = hn::Set(d, kBeyondRange), near = hn::Set(d, kRivalDistance), none = hn::Zero(d);
  auto least = beyond, plane = none;
  for_each_vector(*cell.planes, [&](StoredRange range, int i, auto stored) HWY_ATTR {
    const Cost* sums = cell.sums + range.slot + i;
    const int count = range.planes.count();
    const auto sum = hn::LoadU(d, sums), k = hn::Iota(d, range.planes.first + i);
    // Within the range: what lies before its first plane and behind its last belongs to others.
    const auto has_before = hn::Gt(hn::Iota(d, i), none), has_after = hn::Lt(hn::Iota(d, i + 1), hn::Set(d, count));
    const auto before = hn::IfThenElse(has_before, hn::LoadU(d, sums - 1), beyond);
    const auto after = hn::IfThenElse(has_after, hn::LoadU(d, sums + 1), beyond);
    const auto is_minimum = hn::Not(hn::Or(hn::Lt(before, sum), hn::Lt(after, sum)));
    const auto far = hn::Gt(hn::Abs(hn::Sub(k, hn::Set(d, winner.plane))), near);
    // Planes ascend: of equals in a lane the lower one stays.
    const auto better = hn::And(hn::And(stored, is_minimum), hn::And(far, hn::Lt(sum, least)));
    least = hn::IfThenElse(better, sum, least);
    plane = hn::IfThenElse(better, k, plane);
  });
  winner.rival_sum = hn::GetLane(hn::MinOfLanes(d, least));
  const auto lowest = hn::IfThenElse(hn::Eq(least, hn::Set(d, winner.rival_sum)), plane, hn::Set(d, INT32_MAX));
  winner.rival_plane = hn::GetLane(hn::MinOfLanes(d, lowest));
}

// In halves of 16 bits, whose sums 32 bits hold for as many planes as there may be.
HWY_INLINE void add_up_costs(const CellValues& cell, PlaneWinner& winner) {
  const C d;
  const hn::RebindToUnsigned<C> u;
  const auto worst = hn::Set(d, kWorstCost);
  auto low = hn::Zero(u), high = hn::Zero(u);
  for_each_vector(*cell.planes, [&](StoredRange range, int i, auto stored) HWY_ATTR {
    const auto cost = hn::LoadU(d, cell.costs + range.slot + i);
    const auto known = hn::And(hn::Ne(cost, worst), stored);
    const auto counted = hn::BitCast(u, hn::IfThenElseZero(known, cost));
    low = hn::Add(low, hn::And(counted, hn::Set(u, 0xFFFF)));
    high = hn::Add(high, hn::ShiftRight<16>(counted));
    winner.seen += static_cast<int>(hn::CountTrue(d, known));
  });
  winner.total_cost = hn::GetLane(hn::SumOfLanes(u, low)) + 65536.0 * hn::GetLane(hn::SumOfLanes(u, high));
}

PlaneWinner winner_of(const CellValues& cell) {
  PlaneWinner winner;
  find_least(cell, winner);
  find_rival(cell, winner);
  add_up_costs(cell, winner);
  return winner;
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/check.h"
#include "sweep/cpu/best_planes_cpu.h"

namespace skysweep::sweep::cpu {

HWY_EXPORT(winner_of);

MatchResult best_planes(const CostVolume& costs, const CostVolume& sums, Executor& executor) {
  SKY_CHECK_LT(costs.all_planes().count(), 1 << 16);
  MatchResult result(costs.width(), costs.height());
  executor.parallel_for(costs.height(), [&](int row) {
    for (int column = 0; column < costs.width(); ++column) {
      const PlaneSet& planes = costs.planes_at(column, row);
      if (planes.empty()) continue;
      const CellValues cell{&planes, costs.cell(column, row), sums.cell(column, row)};
      store(HWY_DYNAMIC_DISPATCH(winner_of)(cell), cell, column, row, result);
    }
  });
  return result;
}

}  // namespace skysweep::sweep::cpu
#endif  // HWY_ONCE
