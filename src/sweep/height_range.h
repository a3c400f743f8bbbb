// SPDX-License-Identifier: Apache-2.0
// Where to search: a coarse sweep over everything that could be there, so that the fine one looks only at planes near a
// surface. Coarse cells of kCoarseCells x kCoarseCells cells, photographs read at window levels as much higher.
#pragma once

#include <optional>

#include "core/executor.h"
#include "sweep/backend.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

constexpr int kCoarseCells = 8;

// Lowest and highest surface found, metres.
struct HeightRange {
  double z_low = 0;
  double z_high = 0;
};

// Searches z_low..z_high below `problem.grid` (whose block_planes are not read), then sets block_planes: for each block
// the planes around the trusted heights of the block and its surroundings, the whole tile's where a block has none, and
// none at all when the tile has none. A coarse height is trusted when at least half of its neighbours agree with it.
// Returns the range over the whole tile; nothing when nothing could be matched.
std::optional<HeightRange> find_planes(SweepProblem& problem, double z_low, double z_high, Backend backend,
                                       Executor& executor);

}  // namespace skysweep::sweep
