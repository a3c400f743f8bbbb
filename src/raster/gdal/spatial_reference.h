// SPDX-License-Identifier: Apache-2.0
// Between WKT, as the program keeps it, and GDAL's objects. Call within a GdalSession.
#pragma once

#include <ogr_spatialref.h>

#include <string>

namespace skysweep::raster {

// Axes in the order of GIS files: easting, northing.
OGRSpatialReference spatial_reference_of(const std::string& wkt);
std::string wkt_of(const OGRSpatialReference& crs);

}  // namespace skysweep::raster
