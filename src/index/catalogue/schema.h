// SPDX-License-Identifier: Apache-2.0
// The layers and columns of the catalogue, for its making and for a look whether a file is one.
#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <string>
#include <vector>

#include "index/catalogue/geopackage.h"

namespace skysweep::index {

// Columns that hold a camera and a pose number by number: doubles come back bit for bit.
constexpr std::array<const char*, 11> kCameraColumns = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px",
                                                        "k1",       "k2",        "p1",    "p2",    "k3"};
// Centre of projection and the rows of the rotation from world to camera: its right, down and view direction.
constexpr std::array<const char*, 12> kPoseColumns = {"x",      "y",      "z",      "right_x", "right_y", "right_z",
                                                      "down_x", "down_y", "down_z", "view_x",  "view_y",  "view_z"};

// Throws Error(bad_input) if it cannot be understood.
OGRSpatialReference catalogue_crs(const std::string& wkt);

// Makes the layers `images`, `cameras`, `tiles` and `products` in an empty GeoPackage. Failures are left to the
// caller's QuietGdal.
void make_layers(GDALDataset& dataset, const OGRSpatialReference& crs);

// What a file lacks to be a catalogue, as the rest of a sentence ("has no layer images"); empty if nothing.
std::string what_is_missing(GDALDataset& dataset);

}  // namespace skysweep::index
