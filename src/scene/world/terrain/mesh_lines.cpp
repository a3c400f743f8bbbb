// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/mesh_lines.h"

#include <algorithm>
#include <cmath>

namespace skysweep::scene {

std::vector<double> mesh_lines(double low, double high, double spacing, std::vector<double> creases,
                               const std::vector<FineStretch>& stretches) {
  for (const FineStretch& stretch : stretches) creases.insert(creases.end(), {stretch.low, stretch.high});
  std::erase_if(creases, [&](double line) { return !(line > low && line < high); });
  creases.insert(creases.end(), {low, high});
  std::sort(creases.begin(), creases.end());
  creases.erase(std::unique(creases.begin(), creases.end()), creases.end());

  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < creases.size(); ++i) {
    const double from = creases[i], to = creases[i + 1];
    double here = spacing;
    for (const FineStretch& stretch : stretches)
      if (stretch.low <= from && to <= stretch.high) here = std::min(here, stretch.spacing);
    const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / here - 1e-9)));
    for (int k = 0; k < pieces; ++k) out.push_back(from + (to - from) * k / pieces);
  }
  out.push_back(high);
  return out;
}

}  // namespace skysweep::scene
