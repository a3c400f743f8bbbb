// SPDX-License-Identifier: Apache-2.0
// What a file in a watched folder is good for, told by its name alone.
#pragma once

#include <string>

namespace skysweep::watch {

enum class FileKind {
  photograph,
  poses,    // a poses.csv or cameras.csv, which may grow
  sidecar,  // NAME.json or NAME.csv: perhaps the pose of the photograph NAME.*
  other,    // texts, temporary and half-sent files (.part, .tmp), hidden files and whatever lies in hidden folders
};

// `name`: relative to the watched folder, with '/' between.
FileKind file_kind(const std::string& name);

}  // namespace skysweep::watch
