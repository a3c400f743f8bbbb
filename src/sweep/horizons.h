// SPDX-License-Identifier: Apache-2.0
// What each view sees past a known surface: for a place and a view, the lowest height that the straight line to the
// centre of projection reaches above everything between (a horizon map). Knows the grid only: what stands outside it
// hides nothing, which is why tiles are swept with a collar.
#pragma once

#include <cstdint>
#include <vector>

#include "core/array2d.h"
#include "core/executor.h"
#include "core/vec.h"
#include "sweep/plane_set.h"

namespace skysweep::sweep {

struct Grid;
struct View;

struct HorizonQuestion {
  const Array2d<float>& surface_m;      // heights that hide; NaN cells hide nothing
  const Array2d<std::uint8_t>& wanted;  // cells to work out; from the others everything is seen
  double lowest_m = 0;                  // nobody asks for heights below
  double tolerance_m = 0;               // the surface hides only what lies more than this below the line over it
  int skipped_cells = 0;  // what stands so near to the cell itself hides nothing: edges are not that well known
};

class Horizons {
 public:
  Horizons(const Grid& grid, const std::vector<View>& views, const HorizonQuestion& question, Executor& executor);

  // Metres, in the grid's frame; -infinity where the view sees everything.
  float lowest_visible(int view, int column, int row) const { return lowest_[view](column, row); }

 private:
  std::vector<Array2d<float>> lowest_;
};

}  // namespace skysweep::sweep
