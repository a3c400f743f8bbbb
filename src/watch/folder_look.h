// SPDX-License-Identifier: Apache-2.0
// One look at a whole folder: which files it holds and how they stand.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace skysweep::watch {

// Names relative to the folder, with '/' between -> raster::file_stamp (size, times, entry).
using FolderLook = std::map<std::string, std::string>;

// Every file below the folder that a watcher cares for (file_kind). Nothing if the folder cannot be listed: it may be
// on a disk or a server that is away.
std::optional<FolderLook> look_at_folder(const std::filesystem::path& folder);

}  // namespace skysweep::watch
