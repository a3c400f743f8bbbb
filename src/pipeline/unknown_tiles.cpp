// SPDX-License-Identifier: Apache-2.0
#include "pipeline/unknown_tiles.h"

namespace skysweep::pipeline {

void UnknownTiles::add(const TileOutcome& outcome) {
  ++looked_at;
  if (outcome.valid_share > 0) return;
  if (outcome.views.size() < 2)
    ++too_few_views;
  else
    ++no_surface;
}

std::string UnknownTiles::sentence() const {
  if (count() == 0) return {};
  std::string text =
      "In " + std::to_string(count()) + " of " + std::to_string(looked_at) + " tiles no height is known: ";
  if (too_few_views > 0)
    text += std::to_string(too_few_views) + " are not seen by two photographs from different places";
  if (too_few_views > 0 && no_surface > 0) text += ", and in ";
  if (too_few_views == 0) text += "in ";
  if (no_surface > 0)
    text += std::to_string(no_surface) +
            " no surface stands out (no texture, a repeating one, noise, or a surface outside the heights searched)";
  return text + ".";
}

}  // namespace skysweep::pipeline
