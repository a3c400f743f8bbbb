// SPDX-License-Identifier: Apache-2.0
// What a synthetic scene is made of: ground, buildings, light, a flight over them and the camera that flies. Plain
// values; read from a file by scene/scene_file.h, turned into photographs and exact truth by scene/simulate.h.
//
// Everything is placed in the scene's own frame (x east, y north, z up, metres) whose origin is the south-west corner
// of the mapped area at mean ground height; `origin` puts that frame into the world. A scene and its seed fix every
// byte of the result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_model.h"
#include "core/vec.h"
#include "scene/effect_settings.h"

namespace skysweep::scene {

// Rolling ground: a few sinusoids of seeded directions and phases. Without relief it is the plane z = 0.
struct Terrain {
  double relief_m = 0;       // bound on highest minus lowest ground
  double wavelength_m = 60;  // of the longest wave
};

// Blocks of buildings between streets, everywhere on the ground. Buildings are boxes with level roofs.
struct Town {
  double block_m = 34;      // side of a block between streets
  double street_m = 11;     // width of a street, pavements included
  double heading_deg = 0;   // streets turned clockwise from north
  double min_height_m = 4;  // of a building above the ground at its centre
  double max_height_m = 20;
  double roof_units = 1.5;   // mean number of small boxes (lift houses, chimneys) on a roof
  double cars_per_100m = 5;  // parked along each side of a street
};

// A single building, for scenes whose truth can be told by hand.
struct Building {
  Vec2d center;            // in the scene's frame
  Vec2d size_m;            // sides; x before turning by the heading
  double heading_deg = 0;  // turned clockwise
  double roof_z_m = 0;     // height of the roof in the scene's frame, not above ground
};

// Procedural detail of all surfaces: it never repeats.
struct Texture {
  double contrast = 1;  // factor on the detail; 0: every material has one flat colour
  double finest_m = 0;  // size of the finest detail; 0: half a GSD
};

struct Light {
  double sun_azimuth_deg = 150;  // direction towards the sun, clockwise from north
  double sun_elevation_deg = 50;
  bool shadows = true;  // whether buildings and ground cast them
};

// Parallel strips, flown to and fro, with the top of the photographs in the direction of flight. Strips and views are
// spread evenly, at least as dense as the overlaps ask for.
struct Flight {
  double gsd_m = 0.05;          // at mean ground height; altitude = gsd x focal length in pixels
  double along_overlap = 0.8;   // of consecutive photographs of a strip, 0 to below 1
  double across_overlap = 0.7;  // of neighbouring strips
  double heading_deg = 0;       // of the strips, clockwise from north
  double beyond_area_m = 0;     // how far the outermost positions lie outside the mapped area; negative: inside
  double off_nadir_deg = 0;     // all photographs look forward by this angle
  double tilt_sigma_deg = 0;    // seeded scatter of roll and pitch; of yaw: twice that
  double position_sigma_m = 0;  // seeded scatter of each coordinate
};

enum class PhotoFormat { jpeg, png };

// What the camera makes of the light. Effects that are zero cost nothing and change no byte.
struct Photographs {
  PhotoFormat format = PhotoFormat::jpeg;
  int jpeg_quality = 95;
  double noise_sigma = 0;  // normal noise of each channel of each pixel, grey levels
  double gain_spread = 0;  // standard deviation of the logarithm of each photograph's exposure
};

struct Truth {
  double cell_m = 0;  // of the truth rasters; 0: twice the GSD, rounded to two digits
};

struct Scene {
  std::uint64_t seed = 1;
  Vec3d origin;            // world position of the scene's frame; snapped (camera::snap_position)
  std::string crs;         // as a user names it ("EPSG:32632"); empty: local metric frame
  Vec2d area_m{100, 100};  // mapped area: [0, x] x [0, y] of the scene's frame
  Terrain terrain;
  std::optional<Town> town;
  std::vector<Building> buildings;
  Texture texture;
  Light light;
  camera::CameraModel camera;
  Flight flight;
  Photographs photographs;
  Effects effects;
  Truth truth;

  // Defaults that depend on other members, resolved.
  double finest_detail_m() const;
  double truth_cell_m() const;
  double altitude_m() const { return flight.gsd_m * camera.focal_px(); }  // above z = 0
};

}  // namespace skysweep::scene
