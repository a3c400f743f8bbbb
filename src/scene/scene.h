// SPDX-License-Identifier: Apache-2.0
// What a synthetic scene is made of: ground, buildings, light, a flight over them and the camera that flies. Plain
// values; read from a file by scene/scene_file.h, turned into photographs and exact truth by scene/simulate.h.
//
// Everything is placed in the scene's own frame (x east, y north, z up, metres) whose origin is the south-west corner
// of the mapped area at mean ground height; `origin` puts that frame into the world. A scene and its seed fix every
// byte of the result.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_model.h"
#include "core/vec.h"
#include "scene/effect_settings.h"
#include "scene/flight.h"
#include "scene/objects.h"
#include "scene/terrain.h"

namespace skysweep::scene {

// What covers the ground.
enum class GroundTexture {
  natural,  // procedural: grass, soil, shrubs or a town's streets and yards; on shaped ground rock and sand too
  tiles,    // one pattern, repeated without end: what matching takes for something else
  asphalt,  // grey without contrast: nothing to match
  checker,  // squares of two greys
  image,    // a georeferenced orthophoto, draped over the ground
  none,     // no texture on any surface: each kind of surface has its grey
};

// Procedural detail of all surfaces: it never repeats, but where the ground is told to.
struct Texture {
  double contrast = 1;  // factor on the detail; 0: every material has one flat colour
  double finest_m = 0;  // size of the finest detail; 0: half a GSD
  GroundTexture ground = GroundTexture::natural;
  double period_m = 2;          // side of a tile or of a square of the checker
  std::filesystem::path image;  // of GroundTexture::image
};

struct Light {
  double sun_azimuth_deg = 150;  // direction towards the sun, clockwise from north
  double sun_elevation_deg = 50;
  bool shadows = true;  // whether buildings and ground cast them
};

enum class PhotoFormat { jpeg, png, tiff, exr };  // EXR: linear light as floats
// Ending of its files, without the dot; also the word for it in scene files.
std::string file_ending(PhotoFormat format);

// What the camera makes of the light. Effects that are zero cost nothing and change no byte.
struct Photographs {
  PhotoFormat format = PhotoFormat::jpeg;
  int jpeg_quality = 95;
  double noise_sigma = 0;       // normal noise of each channel of each pixel, grey levels
  double gain_spread = 0;       // standard deviation of the logarithm of each photograph's exposure
  double max_error_levels = 0;  // of a pixel's anti-aliased mean, grey levels: scene/render/photograph.h
};

// EXIF and XMP tags as a drone writes them (formats/photo_metadata.h). Positions need a scene with a crs.
struct Metadata {
  std::string make = "Skysweep", model = "simulated camera";
  double sensor_width_mm = 13.2;  // turns the focal length into millimetres
  std::chrono::sys_seconds start = std::chrono::sys_days{std::chrono::year{2026} / 6 / 21} + std::chrono::hours(10);
  double speed_mps = 8;  // from photograph to photograph: gives the times
};

struct Truth {
  double cell_m = 0;     // of the truth rasters; 0: twice the GSD, rounded to two digits
  int tie_points = 400;  // places looked at for points of the COLMAP model; kept are those that three photographs see
  bool depth = false;    // a depth image of every photograph
};

// Points of known position on open ground, for gcp_list.txt.
struct GroundControl {
  int points = 12;  // places looked at; kept are those on open ground that three photographs see
};

struct Scene {
  std::uint64_t seed = 1;
  Vec3d origin;            // world position of the scene's frame; snapped (camera::snap_position)
  std::string crs;         // as a user names it ("EPSG:32632"); empty: local metric frame
  Vec2d area_m{100, 100};  // mapped area: [0, x] x [0, y] of the scene's frame
  Terrain terrain;
  std::optional<Town> town;
  std::vector<Building> buildings;
  Things things;
  Texture texture;
  Light light;
  camera::CameraModel camera;
  Flight flight;
  std::vector<Flight> further_flights;  // flown after it, with the same camera
  Photographs photographs;
  std::optional<Metadata> metadata;
  Effects effects;
  Truth truth;
  std::optional<GroundControl> ground_control;

  // Defaults that depend on other members, resolved.
  double finest_detail_m() const;
  double truth_cell_m() const;
  double facade_edge_reach_m() const { return 8 * gsd_m(); }  // of the class map: 0.4 m at 5 cm
  // All flights, in the order they are flown; valid as long as the scene is.
  std::vector<const Flight*> flights() const;
  double gsd_m() const;       // the finest of all flights
  double altitude_m() const;  // the first of the first flight, above z = 0
};

}  // namespace skysweep::scene
