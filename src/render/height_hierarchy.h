// SPDX-License-Identifier: Apache-2.0
// Lowest and highest height of the surface over squares of 1, 2 x 2, 4 x 4 ... elements: what a ray passes over without
// looking at them. An element is a cell (boxes) or the patch between four cell centres (bilinear).
#pragma once

#include <limits>
#include <vector>

#include "core/array2d.h"
#include "render/height_field.h"

namespace skysweep::render {

// The shape between the heights.
enum class SurfaceForm {
  boxes,     // every cell is level; upright walls between neighbours of different height
  bilinear,  // through the heights at the cells' centres
};

struct HeightRange {
  float min = std::numeric_limits<float>::infinity();
  float max = -std::numeric_limits<float>::infinity();
  bool empty() const { return min > max; }
};

class HeightHierarchy {
 public:
  HeightHierarchy(const HeightField& field, SurfaceForm form);

  int levels() const { return static_cast<int>(levels_.size()); }
  // Element or square of elements; empty if no part of it can be hit.
  const Array2d<HeightRange>& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

 private:
  std::vector<Array2d<HeightRange>> levels_;  // the last one is 1 x 1
};

}  // namespace skysweep::render
