// SPDX-License-Identifier: Apache-2.0
// Coordinate reference systems (through GDAL and PROJ). The program works in projected metric systems only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "core/vec.h"

namespace skysweep::raster {

// WKT of what a user names ("EPSG:32615", WKT, PROJ string). Throws Error(usage), with a sentence that says what to use
// instead, if it is unknown, geographic (degrees) or in other units than metres.
std::string crs_from_user_input(const std::string& text);

// WKT of a local metric frame without a place on Earth: what poses without CRS are in. Labelled so in every output.
std::string local_metric_crs();

// One line for people: "WGS 84 / UTM zone 15N (EPSG:32615)", or "local metric frame (no CRS given)".
std::string crs_name(const std::string& wkt);

// Whether both name the same system (axes as in GIS files).
bool same_crs(const std::string& wkt_a, const std::string& wkt_b);

struct Wgs84Position {
  double latitude_deg = 0, longitude_deg = 0;  // north and east positive
};

// Where places of a system (easting, northing) lie on Earth, through PROJ; nothing for a local frame. Throws
// Error(usage) for a place that the system does not reach.
std::optional<std::vector<Wgs84Position>> wgs84_positions(const std::string& wkt, const std::vector<Vec2d>& places);

// WKT of the system that a user names for a copy of a map. Degrees and feet are allowed; a vertical part is not,
// because heights are never converted: the copy keeps that of `map_wkt`, if it has one. Throws Error(usage).
std::string output_crs_from_user_input(const std::string& text, const std::string& map_wkt);

// Whether it is a frame without a place on Earth.
bool is_local_crs(const std::string& wkt);

// The horizontal part as ESRI writes it, for .prj files.
std::string esri_wkt(const std::string& wkt);

// The rectangle in system `to` around all that lies in `box` of system `from` (heights do not count), with sides
// densified. Throws Error(usage) if some of it lies outside of what a system covers, or one is local and the other not.
Box2d transformed_extent(const std::string& from, const std::string& to, const Box2d& box);

// What the outputs say about heights: from a compound CRS its vertical part, otherwise that it is unknown.
std::string vertical_reference(const std::string& wkt);

}  // namespace skysweep::raster
