// SPDX-License-Identifier: Apache-2.0
// What may change while a watcher runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "watch/grouping.h"

namespace skysweep::watch {

struct WatchSettings {
  GroupRule group = GroupRule::none;  // for photographs that come from now on
  std::optional<double> group_gap;    // minutes (time; default 10) or metres (distance; default 200)
  int first = 5;                      // photographs that a group has before its project is made
  std::optional<double> poll_s;       // look at the folder so often and ask for no events; none: events if there are
  std::optional<std::size_t> memory_bytes;  // as RunRequest; none: as the watcher was started with
  std::optional<int> threads;               // likewise

  double gap() const;
  std::optional<std::string> problem() const;
};

// `base` with what the section [watch] of the file says: group, group_gap, first, poll_seconds, memory_mib, threads.
// Throws Error(usage) naming file, line and key.
WatchSettings with_file(WatchSettings base, const std::filesystem::path& file);

}  // namespace skysweep::watch
