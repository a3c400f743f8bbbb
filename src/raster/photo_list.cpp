// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/error.h"
#include "raster/photo.h"
#include "raster/photo/kind.h"

namespace skysweep::raster {

namespace fs = std::filesystem;

bool has_photo_name(const fs::path& path) {
  return !path.filename().string().starts_with(".") && is_photo_ending(ending_of(path));
}

std::vector<std::string> list_photos(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw bad_input("the folder " + folder.string() + " does not exist");
  std::vector<std::string> names;
  fs::recursive_directory_iterator it(folder, fs::directory_options::follow_directory_symlink, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    std::error_code ignored;  // a broken link is no photograph
    if (it->is_directory(ignored)) {
      if (it->path().filename().string().starts_with(".")) it.disable_recursion_pending();
    } else if (it->is_regular_file(ignored) && has_photo_name(it->path())) {
      names.push_back(it->path().lexically_relative(folder).generic_string());
    }
  }
  if (error) throw bad_input("the folder " + folder.string() + " cannot be listed: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace skysweep::raster
