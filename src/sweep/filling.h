// SPDX-License-Identifier: Apache-2.0
// Heights for places that too few photographs see to measure them: the ground at the foot of a wall, narrow alleys.
#pragma once

#include <cstdint>
#include <vector>

#include "core/executor.h"
#include "sweep/heights.h"

namespace skysweep::sweep {

// Gives a height to each cell without one that is hidden (sweep/hidden_cells.h) at that height: the distance-weighted
// mean of what the eight directions of the grid first meet, of that only the lower side of a step, which at least two
// directions must meet. Never from the roof: at the height of a roof nothing would hide the cell. Then to gaps of fewer
// than close_gap_cells cells, hidden or not. Standard deviations stay NaN; all other cells stay as they are, and so
// does everything without options.fill. Returns 1 where filled, 0 elsewhere.
Array2d<std::uint8_t> fill_hidden_cells(const SweepProblem& problem, Executor& executor, Heights& heights);

// The height the cells around a gap say for its cell at (column, row): see above. NaN when fewer than two
// directions meet its lower side.
class Background {
 public:
  // `height_m` must outlive this object. `tolerance_m`: heights of one surface scatter by so much.
  Background(const Array2d<float>& height_m, double cell_m, double tolerance_m, Executor& executor);
  float height_at(int column, int row) const;

 private:
  const Array2d<float>& height_m_;
  double cell_m_, tolerance_m_;
  std::vector<Array2d<std::uint16_t>> steps_;  // of each direction, to the first cell with a height; 0: there is none
};

}  // namespace skysweep::sweep
