// SPDX-License-Identifier: Apache-2.0
// Are the edges of buildings where they belong? Precision, recall and F-score of the height steps of a surface against
// those of the true one. docs/evaluation.md states the formulas.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/height_differences.h"

namespace skysweep::report {

// Largest distances, in photographs' GSD, between an edge and its counterpart.
inline constexpr std::array<double, 2> kEdgeTolerancesGsd = {1, 2};

// An edge: the common side of two neighbouring cells whose heights differ by more than a threshold.
struct HeightEdge {
  int column = 0, row = 0;  // of the western or northern of the two cells
  bool to_south = false;    // the other cell lies south of it; else east

  // Middle of the side, in half cells from the centre of the north-west cell: always whole numbers.
  int x_half_cells() const { return 2 * column + (to_south ? 0 : 1); }
  int y_half_cells() const { return 2 * row + (to_south ? 1 : 0); }
  int other_column() const { return column + (to_south ? 0 : 1); }
  int other_row() const { return row + (to_south ? 1 : 0); }
};

// All edges of a height field, row by row. No height, no edge: the border of a hole is none.
std::vector<HeightEdge> height_edges(const Array2d<float>& heights, double step_m);

// How many edges of one surface have a counterpart in the other within a tolerance.
struct EdgeScore {
  std::int64_t true_count = 0;      // true edges
  std::int64_t true_found = 0;      // of these: with a measured edge near by
  std::int64_t measured_count = 0;  // measured edges
  std::int64_t measured_right = 0;  // of these: with a true edge near by
  double precision() const;         // measured_right / measured_count; NaN without measured edges
  double recall() const;            // true_found / true_count; NaN without true edges
  double f_score() const;           // harmonic mean; 0 if one of the two kinds is missing, NaN if both are
};
using EdgeScores = std::array<EdgeScore, kEdgeTolerancesGsd.size()>;

// Edges of the measured surface count where the truth is known. `region` (may be null) is of the cells' size: then only
// edges with one of their two cells in it (above 0) count; their counterparts may lie anywhere.
EdgeScores compare_edges(const HeightDifferences& cells, double step_m, double gsd_m,
                         const Array2d<std::uint8_t>* region);

}  // namespace skysweep::report
