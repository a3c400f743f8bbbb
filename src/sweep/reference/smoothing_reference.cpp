// SPDX-License-Identifier: Apache-2.0
#include "sweep/reference/smoothing_reference.h"

#include <algorithm>

#include "sweep/penalties.h"

namespace skysweep::sweep::reference {
namespace {

// Path costs of one cell; planes that the cell does not search do not exist.
struct PathCosts {
  const PlaneSet* planes = nullptr;
  std::vector<int> values;  // of the planes, ascending

  int at(int k) const {
    int before = 0;
    for (const PlaneRange& range : planes->ranges()) {
      if (range.contains(k)) return values[before + k - range.first];
      before += range.count();
    }
    return kBeyondRange;
  }
  int least() const { return *std::min_element(values.begin(), values.end()); }
};

// `rise`: planes that the surface is expected to rise from the cell before.
PathCosts continue_path(const CostVolume& costs, int column, int row, const PathCosts* before, int rise,
                        int small_penalty, int large_penalty) {
  PathCosts out{&costs.planes_at(column, row), {}};
  const bool begins = !before || before->planes->empty();
  for_each_stored_range(*out.planes, [&](StoredRange range) {
    const Cost* cost = costs.cell(column, row) + range.slot;
    for (int k = range.planes.first; k <= range.planes.last; ++k) {
      int value = *cost++;
      if (!begins) {
        const int same = k - rise;
        const int step = std::min(before->at(same - 1), before->at(same + 1)) + small_penalty;
        const int jump = before->least() + large_penalty;
        value += std::min({before->at(same), step, jump}) - before->least();
      }
      out.values.push_back(value);
    }
  });
  return out;
}

void add_path(const SweepProblem& problem, const CostVolume& costs, int column, int row, int dx, int dy,
              const Penalties& penalties, CostVolume& sums) {
  PathCosts before;
  for (bool first = true; column >= 0 && column < costs.width() && row >= 0 && row < costs.height();
       column += dx, row += dy, first = false) {
    const int rise = first ? 0 : problem.expected_rise(column - dx, row - dy, column, row).planes;
    const int large = first ? 0 : penalties.large(column - dx, row - dy, column, row);
    before = continue_path(costs, column, row, first ? nullptr : &before, rise, penalties.small(), large);
    auto value = before.values.begin();
    for_each_stored_range(*before.planes, [&](StoredRange range) {
      Cost* sum = sums.cell(column, row) + range.slot;
      for (int i = 0; i < range.planes.count(); ++i) sum[i] += *value++;
    });
  }
}

}  // namespace

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs) {
  CostVolume sums(problem, 0);
  const Penalties penalties(problem);
  const int right = costs.width() - 1, bottom = costs.height() - 1;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
    // Every cell whose predecessor lies outside the grid starts a path.
    for (int row = 0; row <= bottom; ++row)
      for (int column = 0; column <= right; ++column)
        if (column - dx < 0 || column - dx > right || row - dy < 0 || row - dy > bottom)
          add_path(problem, costs, column, row, dx, dy, penalties, sums);
  }
  return sums;
}

}  // namespace skysweep::sweep::reference
