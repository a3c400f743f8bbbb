// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/cpu/smoothing_cpu.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "sweep/cpu/path_costs.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using C = hn::CappedTag<Cost, kVolumeLanes>;

// Path costs of one cell from those of the cell before, for all four directions of a pass, added to the sums. Ranges
// are gone through here: what is compiled for all machines alike (for_each_stored_range) takes no vectors in.
void continue_paths(const CellUpdate& cell) {
  const C d;
  const auto small = hn::Set(d, cell.small_penalty), beyond = hn::Set(d, kBeyondRange);
  std::array<Cost, kPathsPerPass> jump;
  alignas(64) std::array<std::array<Cost, kVolumeLanes>, kPathsPerPass> running_least;
  for (int direction = 0; direction < kPathsPerPass; ++direction) {
    jump[direction] = cell.least_before[direction] + cell.large_penalty[direction];
    hn::Store(beyond, d, running_least[direction].data());
  }
  int slot = 0;
  for (const PlaneRange& range : cell.planes->ranges()) {
    const int padded = padded_planes(range);
    for (int i = 0; i < padded; i += static_cast<int>(hn::Lanes(d))) {
      const std::ptrdiff_t k = range.first - cell.lowest_plane + i;
      const auto cost = hn::LoadU(d, cell.costs + slot + i);
      auto sum = hn::LoadU(d, cell.sums + slot + i);
      for (int direction = 0; direction < kPathsPerPass; ++direction) {
        auto value = cost;
        if (const Cost* HWY_RESTRICT before = cell.before[direction]) {
          const auto neighbour = hn::Min(hn::LoadU(d, before + k - 1), hn::LoadU(d, before + k + 1));
          const auto step = hn::Min(hn::LoadU(d, before + k), hn::Add(neighbour, small));
          const auto best = hn::Min(step, hn::Set(d, jump[direction]));
          value = hn::Min(hn::Add(value, hn::Sub(best, hn::Set(d, cell.least_before[direction]))), beyond);
        }
        hn::StoreU(value, d, cell.now[direction] + k);
        sum = hn::Min(hn::Add(sum, value), beyond);
        Cost* least = running_least[direction].data();
        hn::Store(hn::Min(hn::Load(d, least), value), d, least);
      }
      hn::StoreU(sum, d, cell.sums + slot + i);
    }
    slot += padded;
  }
  for (int direction = 0; direction < kPathsPerPass; ++direction)
    cell.least_now[direction] = hn::GetLane(hn::MinOfLanes(d, hn::Load(d, running_least[direction].data())));
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "sweep/cpu/smoothing_cpu.h"
#include "sweep/penalties.h"

namespace skysweep::sweep::cpu {

HWY_EXPORT(continue_paths);

namespace {

// Step from a cell to the one before it on each path of the pass from the north; the pass from the south mirrors both.
constexpr std::array<std::array<int, 2>, kPathsPerPass> kBefore = {{{-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};

void add_pass(const SweepProblem& problem, const CostVolume& costs, bool from_south, const Penalties& penalties,
              CostVolume& sums) {
  const int width = costs.width(), height = costs.height();
  PathRows rows(width, costs.all_planes());
  const int sign = from_south ? -1 : 1;
  for (int i = 0; i < height; ++i) {
    const int row = from_south ? height - 1 - i : i;
    rows.begin_row();
    for (int j = 0; j < width; ++j) {
      const int column = from_south ? width - 1 - j : j;
      const PlaneSet& planes = costs.planes_at(column, row);
      CellUpdate cell;
      cell.planes = &planes;
      cell.lowest_plane = costs.all_planes().first;
      cell.costs = costs.cell(column, row);
      cell.sums = sums.cell(column, row);
      cell.small_penalty = penalties.small();
      rows.forget_outside(column, planes);
      for (int path = 0; path < kPathsPerPass; ++path) {
        const int before_column = column + sign * kBefore[path][0], before_row = row + sign * kBefore[path][1];
        const bool exists = before_column >= 0 && before_column < width && before_row >= 0 && before_row < height &&
                            !costs.planes_at(before_column, before_row).empty();
        const bool same_row = kBefore[path][1] == 0;
        cell.before[path] = exists ? rows.values(path, before_column, same_row) -
                                         problem.expected_rise(before_column, before_row, column, row).planes
                                   : nullptr;
        cell.large_penalty[path] = exists ? penalties.large(before_column, before_row, column, row) : 0;
        cell.least_before[path] = exists ? rows.least(path, before_column, same_row) : Cost{0};
        cell.now[path] = rows.values(path, column, true);
      }
      if (planes.empty()) continue;
      HWY_DYNAMIC_DISPATCH(continue_paths)(cell);
      for (int path = 0; path < kPathsPerPass; ++path) rows.least(path, column, true) = cell.least_now[path];
    }
  }
}

}  // namespace

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs) {
  CostVolume sums(problem, 0);
  const Penalties penalties(problem);
  add_pass(problem, costs, false, penalties, sums);
  add_pass(problem, costs, true, penalties, sums);
  return sums;
}

}  // namespace skysweep::sweep::cpu
#endif  // HWY_ONCE
