// SPDX-License-Identifier: Apache-2.0
#include "watch/file_kind.h"

#include <filesystem>

#include "raster/photo.h"

namespace skysweep::watch {

FileKind file_kind(const std::string& name) {
  if (name.starts_with(".") || name.find("/.") != std::string::npos) return FileKind::other;
  const std::filesystem::path path(name);
  if (raster::has_photo_name(path)) return FileKind::photograph;
  const std::string file = path.filename().string();
  if (file == "poses.csv" || file == "cameras.csv") return FileKind::poses;
  return path.extension() == ".json" || path.extension() == ".csv" ? FileKind::sidecar : FileKind::other;
}

}  // namespace skysweep::watch
