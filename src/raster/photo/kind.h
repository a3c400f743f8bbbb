// SPDX-License-Identifier: Apache-2.0
// What kind of image a file is, told from its first bytes and, where these do not tell, from its ending.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skysweep::raster {

enum class PhotoKind { jpeg, png, tiff, webp, bmp, heif, camera_raw, unknown };

PhotoKind photo_kind(const std::filesystem::path& path, std::string_view first_bytes);

// Lower-case ending without its dot.
std::string ending_of(const std::filesystem::path& path);

// Endings of files that are taken for photographs, those that can only be refused included.
bool is_photo_ending(std::string_view ending);

}  // namespace skysweep::raster
