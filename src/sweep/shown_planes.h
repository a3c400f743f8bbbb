// SPDX-License-Identifier: Apache-2.0
// How many views show a place at each height, without asking every view at every plane.
#pragma once

#include <algorithm>
#include <vector>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// The planes of one place at a time. What a photograph shows of a vertical line is one piece of it, so the ends and a
// bisection tell; where an end lies behind the camera, beyond the fold of its lens, or the line may cut a corner of the
// photograph, plane by plane. Lens distortion bends the line's image: at the border of a photograph planes may be
// counted by which it bulges over the border, and none else. Not for use by several threads at once.
class ShownPlanes {
 public:
  explicit ShownPlanes(const SweepProblem& problem) : problem_(problem) {}

  // From now on (x, y) in the tile's frame, at all `planes` (not empty).
  void look_at(Vec2d place, PlaneRange planes);

  // Calls visit(run, n) for the runs of planes of `planes`, ascending, over which the same number n of views show the
  // place. `planes` must lie within what look_at was given.
  template <typename Visit>
  void for_each_run(PlaneRange planes, Visit visit) const {
    for (int first = planes.first; first <= planes.last;) {
      int n = everywhere_, next = planes.last + 1;
      for (const PlaneRange& shown : partly_) {
        if (shown.contains(first)) ++n, next = std::min(next, shown.last + 1);
        if (shown.first > first) next = std::min(next, shown.first);
      }
      visit(PlaneRange{first, next - 1}, n);
      first = next;
    }
  }

  // Views that show the place at plane k.
  int views_at(int k) const;

 private:
  void add(const View& view, Vec2d place, PlaneRange planes);

  const SweepProblem& problem_;
  int everywhere_ = 0;              // views that show the place at all the planes
  std::vector<PlaneRange> partly_;  // of the others, the planes at which they do
};

}  // namespace skysweep::sweep
