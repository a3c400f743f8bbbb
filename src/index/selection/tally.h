// SPDX-License-Identifier: Apache-2.0
// What the photographs chosen so far do for a tile, and what one more would add.
#pragma once

#include <array>
#include <vector>

#include "index/selection/sightings.h"
#include "index/view_selection.h"

namespace skysweep::index {

enum class Points {
  all,
  in_need,  // only those shown by fewer than min_views of the chosen
};

class Tally {
 public:
  explicit Tally(const ViewSelectionOptions& options) : options_(options) {}

  // Sum over the points of: quality of the view x how far its ray lies from those already chosen there, divided by one
  // more than the number already serving the point. Zero: it adds nothing.
  double gain(const TileView& view, Points points) const;

  void add(const TileView& view);

 private:
  struct Point {
    int heights = 0;          // shown by the chosen, together: kHeights for each that shows the point at all heights
    std::vector<Vec3d> rays;  // of the chosen that count there
  };
  double spread(const Point& point, Vec3d ray) const;

  ViewSelectionOptions options_;
  std::array<Point, kPoints> points_;
};

}  // namespace skysweep::index
