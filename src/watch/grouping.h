// SPDX-License-Identifier: Apache-2.0
// Which photographs make a map together: those of one flight or place, so that others do not mix with it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/vec.h"

namespace skysweep::watch {

enum class GroupRule {
  none,      // all together
  folder,    // by the subfolder they lie in
  time,      // a flight goes on while the next photograph was taken within the gap
  distance,  // a place goes on while the next photograph was taken within the gap
};

std::optional<GroupRule> group_rule_named(const std::string& name);

// With `time` and `distance` groups are the connected components of "nearer than the gap" (single linkage), so that the
// order of arrival makes no difference to who belongs together: a photograph that stands between two groups makes one
// of them, the one that was there first.
class Grouping {
 public:
  // `gap`: minutes for time, metres on the ground for distance.
  Grouping(GroupRule rule, double gap) : rule_(rule), gap_(gap) {}

  // Of photographs placed from now on.
  void use(GroupRule rule, double gap);

  // What an earlier watcher wrote down (text()). Lines that say nothing are ignored.
  void restore(const std::string& text);
  // A table photograph,group of all photographs placed, the groups in the order they were made.
  std::string text() const;

  struct Photograph {
    std::string name;              // relative to the watched folder
    std::optional<double> time_s;  // when it was taken; needed for `time`
    Vec3d center;                  // where, in map coordinates; used for `distance`
  };
  // The group's name, fit for a folder. Once placed, a photograph stays where it is until its group becomes part of
  // another. Nothing when the rule needs a time and there is none.
  std::optional<std::string> place(const Photograph& photograph);

  // Whether it was placed, by this watcher or an earlier one.
  bool knows(const std::string& photograph) const { return group_of_.contains(photograph); }
  std::string group_of(const std::string& photograph) const;

 private:
  using Cell = std::pair<long long, long long>;
  int root_of(int group) const;
  int make_group(const std::string& name);
  int join(const std::vector<int>& groups);
  std::vector<int> near_in_time(double time_s) const;
  std::vector<int> near_on_ground(Vec2d place) const;
  Cell cell_of(Vec2d place) const;
  std::string new_name(const Photograph& photograph) const;

  GroupRule rule_;
  double gap_;
  std::vector<std::string> names_;  // of the groups, in the order they were made
  std::vector<int> parent_;         // of a group that became part of another; its own number otherwise
  std::map<std::string, int> group_of_;
  std::map<std::string, bool> seen_;  // photographs whose time and place are in the two below
  std::multimap<double, int> times_;
  std::map<Cell, std::vector<std::pair<Vec2d, int>>> places_;  // in cells of the gap
};

// A name as a folder's: letters, digits, '.', '_', '-' and what is not ASCII stay; where something had to change, a few
// digits of its digest keep different names apart.
std::string safe_name(const std::string& name);

}  // namespace skysweep::watch
