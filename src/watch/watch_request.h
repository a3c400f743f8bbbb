// SPDX-License-Identifier: Apache-2.0
// What a watcher is asked for.
#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/session.h"
#include "watch/watch_settings.h"

namespace skysweep::watch {

struct WatchRequest {
  // `images` is the folder watched, `project` the root: each group's project lies in a folder of it. `poses`, if not
  // empty, is read instead of the folder's poses.csv. The rest goes to every group's run.
  pipeline::RunRequest run;
  WatchSettings settings;                              // before the file
  std::optional<std::filesystem::path> settings_file;  // read again by reload()
  bool once = false;                                   // whatever is there makes a map, and nothing more is waited for
};

// The settings with those of the file over them. Throws Error(usage) for what makes no sense.
WatchSettings effective_settings(const WatchRequest& request);

// Throws Error(usage) when the folder is missing, when it and the root lie in one another, or when the poses are to
// come from a folder.
void require_sensible_folders(const WatchRequest& request);

}  // namespace skysweep::watch
