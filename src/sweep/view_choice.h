// SPDX-License-Identifier: Apache-2.0
// Which view each cell of an orthophoto takes its colour from: one that agrees with the others, looks straight down and
// is the neighbours' choice, too, changing where the two views that meet look alike.
#pragma once

#include <cstdint>

#include "core/array2d.h"
#include "core/executor.h"
#include "sweep/color_candidates.h"

namespace skysweep::sweep {

// Farthest cells that a choice can depend on.
constexpr int kChoiceReach = 16;

// How far what a candidate shows is from the median of all, mean of the channels, sixteenths of a grey level; 0 where
// fewer than three make a median meaningless.
std::array<std::uint16_t, kMostCandidates> deviations(const CellCandidates& cell);

// Of every cell the candidate (position in CellCandidates::of) that minimises, together with its neighbours' choices,
// the sum over the cells of
//   max(0, deviation - 6) + 16 slope                                        grey levels; slope: of the line of sight
// and over neighbours (8) with different views of
//   seam_cost (1 + half the mean difference of what the two views show in the two cells)
// nearly, by kChoiceReach / 4 rounds of iterated conditional modes (Besag 1986), each in four colours of a chequerboard
// so that the order of cells does not matter. -1 where there is no candidate. seam_cost 0: every cell by itself.
Array2d<std::int8_t> choose_views(const Array2d<CellCandidates>& cells, double seam_cost, Executor& executor);

}  // namespace skysweep::sweep
