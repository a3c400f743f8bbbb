// SPDX-License-Identifier: Apache-2.0
#include "watch/folder_look.h"

#include "raster/file_stamp.h"
#include "watch/file_kind.h"

namespace skysweep::watch {

namespace fs = std::filesystem;

std::optional<FolderLook> look_at_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return std::nullopt;
  FolderLook look;
  fs::recursive_directory_iterator it(folder, fs::directory_options::follow_directory_symlink, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    std::error_code ignored;  // what vanishes meanwhile is not there
    if (it->is_directory(ignored)) {
      if (it->path().filename().string().starts_with(".")) it.disable_recursion_pending();
      continue;
    }
    const std::string name = it->path().lexically_relative(folder).generic_string();
    if (file_kind(name) == FileKind::other) continue;
    if (const auto stamp = raster::file_stamp(it->path())) look[name] = *stamp;
  }
  if (error) return std::nullopt;
  return look;
}

}  // namespace skysweep::watch
