// SPDX-License-Identifier: Apache-2.0
#include "settings/nearest_word.h"

#include <algorithm>

#include "core/array2d.h"

namespace skysweep::settings {

int edit_distance(const std::string& a, const std::string& b) {
  const int rows = static_cast<int>(a.size());
  const int columns = static_cast<int>(b.size());
  Array2d<int> distance(columns + 1, rows + 1);  // (j, i): from the first i characters of a to the first j of b
  for (int i = 0; i <= rows; ++i) distance(0, i) = i;
  for (int j = 0; j <= columns; ++j) distance(j, 0) = j;
  for (int i = 1; i <= rows; ++i) {
    for (int j = 1; j <= columns; ++j) {
      int best = distance(j - 1, i - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      best = std::min({best, distance(j, i - 1) + 1, distance(j - 1, i) + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        best = std::min(best, distance(j - 2, i - 2) + 1);
      distance(j, i) = best;
    }
  }
  return distance(columns, rows);
}

std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string* nearest = nullptr;
  int nearest_distance = 0;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(word, candidate);
    if (3 * distance > static_cast<int>(std::max(word.size(), candidate.size()))) continue;
    if (nearest && distance >= nearest_distance) continue;
    nearest = &candidate;
    nearest_distance = distance;
  }
  if (!nearest) return std::nullopt;
  return *nearest;
}

}  // namespace skysweep::settings
