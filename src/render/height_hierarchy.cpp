// SPDX-License-Identifier: Apache-2.0
#include "render/height_hierarchy.h"

#include <algorithm>
#include <cmath>

namespace skysweep::render {
namespace {

void include(HeightRange& range, float height) {
  range.min = std::min(range.min, height);
  range.max = std::max(range.max, height);
}

Array2d<HeightRange> ranges_of_cells(const Array2d<float>& height_m) {
  Array2d<HeightRange> ranges(height_m.width(), height_m.height());
  for (int y = 0; y < ranges.height(); ++y)
    for (int x = 0; x < ranges.width(); ++x)
      if (std::isfinite(height_m(x, y))) include(ranges(x, y), height_m(x, y));
  return ranges;
}

// A patch is there if all of its four corners are.
Array2d<HeightRange> ranges_of_patches(const Array2d<float>& height_m) {
  Array2d<HeightRange> ranges(std::max(0, height_m.width() - 1), std::max(0, height_m.height() - 1));
  for (int y = 0; y < ranges.height(); ++y)
    for (int x = 0; x < ranges.width(); ++x) {
      HeightRange range;
      bool complete = true;
      for (const float h : {height_m(x, y), height_m(x + 1, y), height_m(x, y + 1), height_m(x + 1, y + 1)}) {
        complete = complete && std::isfinite(h);
        include(range, h);
      }
      if (complete) ranges(x, y) = range;
    }
  return ranges;
}

Array2d<HeightRange> coarser(const Array2d<HeightRange>& finer) {
  Array2d<HeightRange> ranges((finer.width() + 1) / 2, (finer.height() + 1) / 2);
  for (int y = 0; y < finer.height(); ++y)
    for (int x = 0; x < finer.width(); ++x) {
      HeightRange& range = ranges(x / 2, y / 2);
      range.min = std::min(range.min, finer(x, y).min);
      range.max = std::max(range.max, finer(x, y).max);
    }
  return ranges;
}

}  // namespace

HeightHierarchy::HeightHierarchy(const HeightField& field, SurfaceForm form) {
  levels_.push_back(form == SurfaceForm::boxes ? ranges_of_cells(field.height_m) : ranges_of_patches(field.height_m));
  if (levels_.front().empty()) levels_.front() = Array2d<HeightRange>(1, 1);
  while (levels_.back().size() > 1) levels_.push_back(coarser(levels_.back()));
}

}  // namespace skysweep::render
