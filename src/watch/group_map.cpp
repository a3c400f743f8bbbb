// SPDX-License-Identifier: Apache-2.0
#include "watch/group_map.h"

#include <algorithm>

namespace skysweep::watch {

void GroupMap::set_members(std::map<std::string, formats::PosedImage> now, const std::set<std::string>& touched) {
  for (const auto& [name, image] : now) {
    const auto before = members.find(name);
    const bool same =
        before != members.end() && before->second.model == image.model && before->second.pose == image.pose;
    if (!same || touched.contains(name)) due.insert(name);
  }
  const bool lost = std::any_of(members.begin(), members.end(), [&](const auto& m) { return !now.contains(m.first); });
  std::erase_if(due, [&](const std::string& name) { return !now.contains(name); });
  stale = stale || lost || !due.empty();
  members = std::move(now);
}

bool GroupMap::ready(int first, double now_s) const {
  if (!stale || members.empty() || now_s < retry_s) return false;
  return has_project || static_cast<int>(members.size()) >= first;
}

int GroupMap::mapped_photographs() const {
  if (!mapped) return 0;
  return static_cast<int>(std::count_if(members.begin(), members.end(), [&](const auto& member) {
    return !due.contains(member.first) && !refused.contains(member.first);
  }));
}

GroupStatus GroupMap::status(const std::string& name, int first) const {
  GroupStatus status{name, static_cast<int>(members.size()), tiles_computed, "up to date", trouble};
  if (!trouble.empty()) {
    status.state = "in trouble";
  } else if (members.empty()) {
    status.state = "left as it is";
    status.reason = left_because;
  } else if (stale && !has_project && static_cast<int>(members.size()) < first) {
    status.state = "waiting";
    status.reason = "A map is begun with " + std::to_string(first) + " photographs; there are " +
                    std::to_string(members.size()) + ".";
  } else if (stale) {
    status.state = "due";
  }
  return status;
}

pipeline::RunRequest request_for(const GroupMap& group, const std::string& name, pipeline::RunRequest base) {
  base.project /= name;
  base.given.emplace();
  for (const auto& [photograph, image] : group.members) {
    base.given->names.push_back(photograph);
    base.given->poses.images.push_back(image);
  }
  return base;
}

}  // namespace skysweep::watch
