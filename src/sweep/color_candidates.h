// SPDX-License-Identifier: Apache-2.0
// The views that see a cell past the surface, and the colours they show there: what an orthophoto is chosen from.
#pragma once

#include <array>
#include <cstdint>

#include "core/array2d.h"
#include "core/color.h"
#include "core/executor.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Enough for a median that outlasts what moves; further views look on more aslant.
constexpr int kMostCandidates = 8;

struct ColorCandidate {
  Rgb8 color;
  std::int8_t view = -1;   // position in problem.views
  std::uint8_t slope = 0;  // of the line of sight, horizontal over vertical, in 1/kSlopeScale; 255: that or more
};
constexpr int kSlopeScale = 128;

// Those nearest to the vertical, in that order.
struct CellCandidates {
  std::array<ColorCandidate, kMostCandidates> of;
  std::uint8_t count = 0;
  std::uint8_t seen_by = 0;  // views that see the cell, candidates or not

  const ColorCandidate* begin() const { return of.data(); }
  const ColorCandidate* end() const { return of.data() + count; }
  // What a view shows; null if it is no candidate.
  const ColorCandidate* find(int view) const;
};

// The cells of the grid's core and `margin` more on every side, as far as the grid has them.
struct CoreWithMargin {
  CoreWithMargin(const SweepProblem& problem, int margin);
  int first_column, first_row, width, height;  // in the grid
};

// Of every cell of the region that has a height (row 0, column 0: the region's first), with the rays of
// sweep/visibility.h.
Array2d<CellCandidates> color_candidates(const SweepProblem& problem, const Array2d<float>& height_m,
                                         const CoreWithMargin& region, Executor& executor);

// What a view shows at a pixel, as finely as cells need it.
Rgb8 color_at(const View& view, Vec2d pixel);

}  // namespace skysweep::sweep
