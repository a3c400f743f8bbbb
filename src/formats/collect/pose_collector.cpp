// SPDX-License-Identifier: Apache-2.0
#include "formats/collect/pose_collector.h"

#include <algorithm>

#include "core/error.h"

namespace skysweep::formats {
namespace {

// Positions of any map, and of the Earth's centre, are well below this (metres); snapping is exact up to here.
constexpr double kFarthest = 1e9;

// Why the entry cannot be used, without the place; nothing if it can.
std::optional<std::string> problem_of(const PosedImage& image) {
  if (image.name.empty()) return "the image has no name";
  if (const auto problem = image.model.problem()) return "the camera cannot be used: " + *problem;
  if (const auto problem = image.pose.problem()) return "the pose cannot be used: " + *problem;
  const Vec3d c = image.pose.center;
  if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > kFarthest)
    return "the position lies more than 10^9 m from the origin";
  return std::nullopt;
}

}  // namespace

void PoseCollector::add(PosedImage image) {
  std::string reason;
  if (const auto problem = problem_of(image))
    reason = image.where + ": " + *problem + ".";
  else
    image.pose.center = camera::snap_position(image.pose.center);
  entries_.push_back({std::move(image), std::move(reason)});
}

void PoseCollector::refuse(std::string name, std::string where, std::string reason) {
  entries_.push_back({{std::move(name), {}, {}, std::move(where)}, std::move(reason)});
}

PoseSet PoseCollector::finish() && {
  if (entries_.empty()) throw bad_input(source_ + ": holds no images; there is nothing to map from.");
  const std::string first_reason = entries_.front().reason;
  const std::size_t count = entries_.size();
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.image.name < b.image.name; });
  PoseSet set;
  for (std::size_t i = 0, next = 0; i < entries_.size(); i = next) {
    next = i + 1;
    while (next < entries_.size() && entries_[next].image.name == entries_[i].image.name) ++next;
    const std::string& name = entries_[i].image.name;
    if (next - i > 1 && !name.empty()) {
      std::string places = entries_[i].image.where;
      for (std::size_t k = i + 1; k < next; ++k) places += (k + 1 == next ? " and " : ", ") + entries_[k].image.where;
      set.refused.push_back({name, places + ": all give a pose for image '" + name + "'; keep one of them."});
      continue;
    }
    for (std::size_t k = i; k < next; ++k) {
      if (entries_[k].reason.empty())
        set.images.push_back(std::move(entries_[k].image));
      else
        set.refused.push_back({entries_[k].image.name, std::move(entries_[k].reason)});
    }
  }
  if (set.images.empty())
    throw bad_input(source_ + ": none of its " + std::to_string(count) + " images can be used. The first: " +
                    (first_reason.empty() ? set.refused.front().reason : first_reason));
  set.notes = std::move(notes_);
  return set;
}

}  // namespace skysweep::formats
