// SPDX-License-Identifier: Apache-2.0
// Are the edges of buildings where they belong? Precision, recall and F-score of the height steps of a surface against
// those of the true one. docs/evaluation.md states the formulas.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/height_differences.h"

namespace skysweep::report {

// Largest distances between an edge and its counterpart, in units of the photographs' GSD or of a cell, whichever is
// larger: the place of a side is known to no better than a cell.
inline constexpr std::array<double, 2> kEdgeTolerances = {1, 2};

// An edge: the common side of two neighbouring cells on which a step of the surface is concentrated.
struct HeightEdge {
  int column = 0, row = 0;  // of the western or northern of the two cells
  bool to_south = false;    // the other cell lies south of it; else east

  // Middle of the side, in half cells from the centre of the north-west cell: always whole numbers.
  int x_half_cells() const { return 2 * column + (to_south ? 0 : 1); }
  int y_half_cells() const { return 2 * row + (to_south ? 1 : 0); }
  int other_column() const { return column + (to_south ? 0 : 1); }
  int other_row() const { return row + (to_south ? 1 : 0); }
};

// All edges of a height field, row by row: sides across which the heights step by more than `step_m`. A step is what
// the heights rise (or fall) on the side and on those beside it in the same row or column, as long as they go the same
// way, less the slope that goes on behind them: a wall that was measured over two or three cells is one edge, a slope
// is none. Of the sides fewer than three cells apart that step the same way only the strongest is an edge. No height,
// no edge: the border of a hole is none.
std::vector<HeightEdge> height_edges(const Array2d<float>& heights, double step_m);

// How many edges of one surface have a counterpart in the other within a tolerance.
struct EdgeScore {
  double tolerance_m = 0;           // largest distance of a counterpart
  std::int64_t true_count = 0;      // true edges
  std::int64_t true_found = 0;      // of these: with a measured edge near by
  std::int64_t measured_count = 0;  // measured edges
  std::int64_t measured_right = 0;  // of these: with a true edge near by
  double precision() const;         // measured_right / measured_count; NaN without measured edges
  double recall() const;            // true_found / true_count; NaN without true edges
  double f_score() const;           // harmonic mean; 0 if one of the two kinds is missing, NaN if both are
};
using EdgeScores = std::array<EdgeScore, kEdgeTolerances.size()>;

// Edges of the measured surface count where the truth is known. `region` (may be null) is of the cells' size: then only
// edges with one of their two cells in it (above 0) count; their counterparts may lie anywhere.
EdgeScores compare_edges(const HeightDifferences& cells, double step_m, double gsd_m,
                         const Array2d<std::uint8_t>* region);

}  // namespace skysweep::report
