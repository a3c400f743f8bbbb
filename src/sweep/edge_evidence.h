// SPDX-License-Identifier: Apache-2.0
// How sure it is which of the surfaces at a step a cell belongs to (step_edges.h).
#pragma once

#include "core/array2d.h"

namespace skysweep::sweep {

// Cell by cell, in units of the difference between colours that is usual in the tile; NaN in cells that had no choice.
// Empty where nobody looked.
struct EdgeEvidence {
  Array2d<float> margin;      // by how much the next best surface would cost more; below 0 if others moved since
  Array2d<float> difference;  // between the colours of the views that see the one chosen, as its cost counts it
};

}  // namespace skysweep::sweep
