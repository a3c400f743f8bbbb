// SPDX-License-Identifier: Apache-2.0
// How a watcher stands, as a line for people, JSON for programs and text for Prometheus.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skysweep::watch {

struct GroupStatus {
  std::string name;
  int photographs = 0;
  long long tiles_computed = 0;  // since the watcher began
  std::string state;             // up to date, waiting, being mapped, due, in trouble
  std::string reason;            // a sentence, where there is something to say
};

struct Status {
  std::string state;     // waiting, mapping, or what is wrong with the folder
  std::string looks_by;  // events or polling
  int photographs = 0;   // complete and usable as files
  int arriving = 0;      // files not yet complete
  int waiting_for_pose = 0;
  int poses_waiting = 0;  // for their photographs
  int due = 0;            // complete, with pose, not yet in a map
  int mapped = 0;         // photographs that are in a map
  int quarantined = 0;
  long long batches = 0;
  std::string stage;  // of the batch in work, with units done and to do
  int stage_done = 0, stage_total = 0;
  std::optional<double> median_seconds_to_tiles;  // from a photograph and its pose to its tiles
  std::vector<std::string> troubles;              // sentences: pose files that cannot be read and the like
  std::vector<GroupStatus> groups;
};

std::string status_line(const Status& status);
// `updated`: seconds since 1970, which tells a reader whether the watcher is alive.
std::string status_json(const Status& status, double updated);
std::string prometheus_text(const Status& status);

}  // namespace skysweep::watch
