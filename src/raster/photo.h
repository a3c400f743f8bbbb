// SPDX-License-Identifier: Apache-2.0
// Photographs on disk (decoded by OpenCV). Pixels come in stored orientation: the EXIF orientation is not applied,
// because poses from every tool mean the stored pixels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"

namespace skysweep::raster {

// Decodes a photograph to 8-bit RGB: grey becomes RGB, 16 bits are scaled to 8, an alpha channel is dropped.
// Throws Error(bad_input), a sentence naming the file, when it is missing, empty, not an image, cut off (a truncated
// JPEG is refused, not half used), or of a kind that has to be converted first (HEIC, DNG and other raw formats: the
// sentence says how).
Array2d<Rgb8> read_photo(const std::filesystem::path& path);

// Throws what `read_photo` would as far as that can be told without decoding: the file is read and walked to its end.
void require_whole_photo(const std::filesystem::path& path);

struct PhotoSize {
  int width_px = 0;
  int height_px = 0;
};

// Size in stored orientation, from the header alone where the format allows. Same errors, as far as the header shows.
PhotoSize read_photo_size(const std::filesystem::path& path);

// Photographs below a folder, with all subfolders: paths relative to it with '/' between, sorted bytewise. Files are
// taken by their ending, in any case (jpg jpeg png tif tiff webp bmp; and heic heif dng and raw formats, so that they
// can be refused by name); hidden files and folders are left out. Throws Error(bad_input) if the folder is missing.
std::vector<std::string> list_photos(const std::filesystem::path& folder);

// Whether `list_photos` would take a file of this name for a photograph; nothing is looked at.
bool has_photo_name(const std::filesystem::path& path);

// The bytes of an image in the format of the path's ending (PNG, JPEG, TIFF); nothing is written.
std::string encode_image(const std::filesystem::path& path, const Array2d<Rgb8>& image, int jpeg_quality = 95);

// Writes an image in the format of the path's ending (PNG, JPEG, TIFF), atomically.
void write_image(const std::filesystem::path& path, const Array2d<Rgb8>& image, int jpeg_quality = 95);

}  // namespace skysweep::raster
