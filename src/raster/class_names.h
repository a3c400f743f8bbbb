// SPDX-License-Identifier: Apache-2.0
// What the codes of a raster of classes mean.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skysweep::raster {

// Names by code (names[2] belongs to the value 2, "" where a code has none): the category names that GDAL finds in the
// raster or the .aux.xml file beside it; else those of the metadata item CLASS_NAMES, separated by commas; else those
// of its label, "surface class: 1 ground, 2 roof" (what simulate writes). Empty if there are none. Throws
// Error(bad_input) naming the file if it is no raster.
std::vector<std::string> read_class_names(const std::filesystem::path& path);

}  // namespace skysweep::raster
