// SPDX-License-Identifier: Apache-2.0
// When a photograph was taken, as its EXIF tags say.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace skysweep::formats {

// DateTimeOriginal with SubSecTimeOriginal and OffsetTimeOriginal; without an offset the camera's clock is taken for
// UTC, which keeps the distances between its photographs. Nothing if the file has no such tag or cannot be read.
std::optional<std::chrono::sys_time<std::chrono::milliseconds>> time_taken(const std::filesystem::path& photo);

}  // namespace skysweep::formats
