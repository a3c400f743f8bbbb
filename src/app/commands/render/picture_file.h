// SPDX-License-Identifier: Apache-2.0
// A rendered picture as a file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/commands/render/options.h"

namespace skysweep::app {

// PNG, JPEG or WebP. Replaces the file at once. Throws Error(failed) naming it.
void write_picture(const std::filesystem::path& path, PictureKind kind, int quality, const Array2d<Rgb8>& picture);

// OpenEXR: R, G, B in linear light, Z (distance along the ray), position.X/Y/Z from the attribute `origin`,
// normal.X/Y/Z, level; NaN, or the background's colour, where nothing was hit.
void write_layers(const std::filesystem::path& path, const Array2d<Rgb8>& picture, const render::PictureLayers& layers,
                  std::map<std::string, std::string> labels);

}  // namespace skysweep::app
