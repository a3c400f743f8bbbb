// SPDX-License-Identifier: Apache-2.0
#include "watch/watch_request.h"

#include "core/error.h"

namespace skysweep::watch {

namespace fs = std::filesystem;

namespace {

bool lies_in(const fs::path& inner, const fs::path& outer) {
  const fs::path relative = inner.lexically_relative(outer);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

WatchSettings effective_settings(const WatchRequest& request) {
  if (const auto problem = request.settings.problem()) throw usage_error("Watching: " + *problem + ".");
  return request.settings_file ? with_file(request.settings, *request.settings_file) : request.settings;
}

void require_sensible_folders(const WatchRequest& request) {
  const fs::path &folder = request.run.images, &root = request.run.project, &poses = request.run.poses;
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw usage_error("The folder to watch, " + folder.string() + ", does not exist; make it first.");
  const fs::path from = fs::weakly_canonical(folder, error), to = fs::weakly_canonical(root, error);
  if (lies_in(to, from) || lies_in(from, to))
    throw usage_error("The maps' folder " + root.string() + " and the folder watched, " + folder.string() +
                      ", must not lie in one another.");
  if (!poses.empty() && fs::is_directory(poses, error))
    throw usage_error("--poses of watch takes a file, and " + poses.string() + " is a folder.");
}

}  // namespace skysweep::watch
