// SPDX-License-Identifier: Apache-2.0
// Photographs of a scene on disk.
#pragma once

#include <filesystem>
#include <string>

#include "core/array2d.h"
#include "core/color.h"
#include "formats/photo_metadata.h"
#include "scene/scene.h"

namespace skysweep::scene {

// Ending of the files, without its dot.
std::string file_ending(PhotoFormat format);

// Atomically, with the tags unless `metadata` is null.
void write_photograph(const std::filesystem::path& path, const Array2d<Rgb8>& photo, int jpeg_quality,
                      const formats::PhotoMetadata* metadata);

}  // namespace skysweep::scene
