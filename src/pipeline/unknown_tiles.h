// SPDX-License-Identifier: Apache-2.0
// In words, what a pass over the tiles could not know.
#pragma once

#include <string>

#include "pipeline/tile_job.h"

namespace skysweep::pipeline {

struct UnknownTiles {
  int looked_at = 0;
  int too_few_views = 0;  // without two photographs that see them from different places
  int no_surface = 0;     // with them, but no surface stands out

  void add(const TileOutcome& outcome);
  int count() const { return too_few_views + no_surface; }
  // How many tiles have no height at all, and why; empty if all have some.
  std::string sentence() const;
};

}  // namespace skysweep::pipeline
