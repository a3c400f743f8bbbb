// SPDX-License-Identifier: Apache-2.0
// Which photographs serve a tile best: those that together show every part of it N times, from near nadir, at fine
// ground sampling distance, and from different sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/box.h"

namespace skysweep::index {

struct ViewSelectionOptions {
  int views_per_place = 10;           // N: every part of the tile is shown this often, where it can be
  int max_views = 32;                 // and at most so many photographs serve the whole tile
  double max_off_nadir_deg = 40;      // steeper rays than this from nadir at a point do not count for the point
  double min_baseline_ratio = 0.05;   // views closer together than this share of the depth add no height information
  double full_baseline_ratio = 0.25;  // farther apart than this they add no more than at this
  // Nothing when the options can be used, else a sentence that says what to change.
  std::optional<std::string> problem() const;
};

// A photograph that may see the tile. `camera` is in the tile's own frame (Camera::relative_to), so that the choice
// does not change when the whole scene is moved.
struct ViewCandidate {
  std::string name;
  camera::Camera camera;
};

struct ViewVerdict {
  std::string name;
  bool chosen = false;
  int rank = 0;              // 1 = chosen first; 0 when not chosen
  double coverage = 0;       // share of the tile it shows at the given heights
  double off_nadir_deg = 0;  // of the ray to the middle of the tile
  double gsd_m = 0;          // in the middle of the tile
  std::string reason;        // in words, for `info`
};

struct ViewSelection {
  std::vector<int> chosen;            // positions in `candidates`, ascending by name
  std::vector<ViewVerdict> verdicts;  // one per candidate, in the candidates' order
};

// `tile` is the rectangle in the tile's own frame (south-west corner usually (0, 0)); the ground lies between z_low and
// z_high. Deterministic: depends on the candidates as a set, ties go to the name that sorts first.
ViewSelection select_views(const std::vector<ViewCandidate>& candidates, const Box2d& tile, double z_low, double z_high,
                           const ViewSelectionOptions& options);

}  // namespace skysweep::index
