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

// Lowest and highest surface, metres.
struct HeightRange {
  double z_low = 0;
  double z_high = 0;
};

// The surface between z_low and z_high as a coarse sweep over `problem.grid` finds it (block_planes are not read), one
// height per kCoarseCells x kCoarseCells cells from the north-west corner on. Only what can be trusted: heights whose
// cost stands out and that belong to a connected surface of some size; all else is NaN.
Array2d<float> coarse_surface(const SweepProblem& problem, double z_low, double z_high, Backend backend,
                              Executor& executor);

// Sets problem.block_planes: for each block the planes around the coarse heights of the block and its surroundings, the
// whole tile's where the surface is unknown in more than a quarter of a block, and none at all when the tile has none.
// Returns the range over the whole tile; nothing when the surface is empty.
std::optional<HeightRange> search_near(const Array2d<float>& surface, SweepProblem& problem);

}  // namespace skysweep::sweep
