// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_set.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace skysweep::sweep {

void PlaneRange::include(PlaneRange other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  first = std::min(first, other.first);
  last = std::max(last, other.last);
}

PlaneRange planes_between(double z_low, double z_high, double dz_m, int margin) {
  SKY_CHECK(dz_m > 0 && z_low <= z_high);
  return {static_cast<int>(std::floor(z_low / dz_m)) - margin, static_cast<int>(std::ceil(z_high / dz_m)) + margin};
}

PlaneSet::PlaneSet(PlaneRange range) {
  if (!range.empty()) ranges_.push_back(range);
}

int PlaneSet::count() const {
  int planes = 0;
  for (const PlaneRange& range : ranges_) planes += range.count();
  return planes;
}

PlaneRange PlaneSet::hull() const {
  return empty() ? PlaneRange{} : PlaneRange{ranges_.front().first, ranges_.back().last};
}

bool PlaneSet::contains(PlaneRange range) const {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](PlaneRange r) { return r.first <= range.first && range.last <= r.last; });
}

void PlaneSet::include(PlaneRange range) {
  if (range.empty()) return;
  // What overlaps or touches it becomes part of it.
  const auto first =
      std::find_if(ranges_.begin(), ranges_.end(), [&](PlaneRange r) { return r.last + 1 >= range.first; });
  auto last = first;
  for (; last != ranges_.end() && last->first <= range.last + 1; ++last) range.include(*last);
  ranges_.insert(ranges_.erase(first, last), range);
}

void PlaneSet::include(const PlaneSet& other) {
  for (const PlaneRange& range : other.ranges_) include(range);
}

void PlaneSet::clip(PlaneRange range) {
  for (PlaneRange& r : ranges_) r = {std::max(r.first, range.first), std::min(r.last, range.last)};
  std::erase_if(ranges_, [](PlaneRange r) { return r.empty(); });
}

void PlaneSet::bridge(int planes) {
  std::vector<PlaneRange> bridged;
  for (const PlaneRange& range : ranges_) {
    if (!bridged.empty() && range.first - bridged.back().last - 1 <= planes)
      bridged.back().last = range.last;
    else
      bridged.push_back(range);
  }
  ranges_ = std::move(bridged);
}

}  // namespace skysweep::sweep
