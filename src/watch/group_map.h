// SPDX-License-Identifier: Apache-2.0
// One group of a watcher: its photographs and how its map stands with them.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "formats/pose_set.h"
#include "pipeline/session.h"
#include "watch/status.h"

namespace skysweep::watch {

struct GroupMap {
  std::map<std::string, formats::PosedImage> members;
  std::set<std::string> due;                   // members that came or changed since the last batch
  bool stale = false;                          // something has changed since the last batch, perhaps that one went
  bool mapped = false;                         // by this watcher
  bool has_project = false;                    // on disk, perhaps from before
  double retry_s = 0;                          // not before
  std::optional<double> held_since_s;          // a member is being sent again
  std::string trouble;                         // why the last batch was none
  std::string left_because;                    // why it has no members any more
  std::map<std::string, std::string> refused;  // by the last batch
  long long tiles_computed = 0;
  long long last_batch = 0;  // number of the last one begun
  // Of the last batch, until the map is finished.
  std::optional<std::pair<pipeline::RunRequest, pipeline::RunSummary>> unfinished;

  // Takes other members in; photographs in `touched` are due even if their pose is the same.
  void set_members(std::map<std::string, formats::PosedImage> now, const std::set<std::string>& touched);
  // Enough to begin with, and not waiting for better times.
  bool ready(int first, double now_s) const;
  int mapped_photographs() const;
  GroupStatus status(const std::string& name, int first) const;
};

// What `run` is asked for in the name of a group.
pipeline::RunRequest request_for(const GroupMap& group, const std::string& name, pipeline::RunRequest base);

}  // namespace skysweep::watch
