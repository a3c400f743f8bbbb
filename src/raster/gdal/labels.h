// SPDX-License-Identifier: Apache-2.0
// Where a GDAL dataset keeps our GeoReference and Labels: one place for all that writes or reads them.
#pragma once

#include <optional>
#include <string>

#include "raster/gdal/session.h"
#include "raster/geotiff.h"

namespace skysweep::raster {

void put_georeference(GDALDataset& dataset, const GeoReference& georeference);
void put_labels(GDALDataset& dataset, const Labels& labels);

Labels labels_of(GDALDataset& dataset);

// Nothing, and the reason as the rest of a sentence in `problem`, unless the raster is north-up with square cells. A
// file without CRS is taken to be in a local metric frame.
std::optional<GeoReference> georeference_of(GDALDataset& dataset, std::string& problem);

}  // namespace skysweep::raster
