// SPDX-License-Identifier: Apache-2.0
// What the numbers mean, beside formats that cannot say it themselves.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "export/destination.h"
#include "export/map_raster.h"

namespace skysweep::exports {

// CRS, vertical reference, no-data value, units, software, digest: the words of every label by name.
std::map<std::string, std::string> label_words(const MapRaster& map);

// labels.json: the labels and what else there is to say.
void write_labels_json(const MapRaster& map, const std::map<std::string, std::string>& more,
                       const std::filesystem::path& path);

// For the result grid.asc, grid.prj and grid.asc.aux.xml (GDAL's), which GDAL and QGIS read with it; a local frame has
// no .prj. `no_data`: the words for a cell without value in this format.
void write_side_files(const MapRaster& map, const std::string& no_data, const Destination& to);

}  // namespace skysweep::exports
