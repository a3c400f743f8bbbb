// SPDX-License-Identifier: Apache-2.0
// Float images with named channels as OpenEXR files (through OpenEXR): light without the steps and limits of grey
// levels, depths in metres. Files are written whole or not at all and hold no time stamps.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/array2d.h"

namespace skysweep::raster {

struct ExrImage {
  std::map<std::string, Array2d<float>> channels;  // "R", "G", "B", or "Z" for depth; all of one size
  std::map<std::string, std::string> labels;       // text attributes of the header: content, units, software
};

// 32-bit floats, lossless. Throws Error(failed) naming the file.
void write_exr(const std::filesystem::path& path, const ExrImage& image);

// All channels, half floats and integers as floats, and all text attributes. Throws Error(bad_input) naming the file:
// missing, damaged, no single-part scan-line or tiled image.
ExrImage read_exr(const std::filesystem::path& path);

}  // namespace skysweep::raster
