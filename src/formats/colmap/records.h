// SPDX-License-Identifier: Apache-2.0
// The records of a COLMAP model as they lie in its files, before anything is made of them: the same for text and
// binary. Format: "Output Format" in COLMAP's documentation (Schoenberger and Frahm 2016).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/vec.h"

namespace skysweep::formats::colmap {

struct CameraRecord {
  std::uint32_t id = 0;
  std::string model;  // "OPENCV"
  std::uint64_t width_px = 0, height_px = 0;
  std::vector<double> parameters;  // in the model's order
  std::string where;               // "cameras.txt:4"
  std::string problem;             // a sentence if the entry could not be read whole
};

struct ImageRecord {
  std::array<double, 4> cam_from_world_wxyz = {1, 0, 0, 0};
  Vec3d translation;  // camera = R * world + translation
  std::uint32_t camera_id = 0;
  std::string name;
  std::string where;
  std::string problem;
};

struct PointRecord {
  std::uint64_t id = 0;
  Vec3d position;
  double reprojection_error_px = 0;
  std::size_t track_length = 0;  // observations
};

enum class Encoding { text, binary };

// All throw Error(bad_input), with file and line or record, when the file's structure is broken; an image or camera
// that is only wrong in itself comes back with its `problem`. The 2D observations are skipped.
std::vector<CameraRecord> read_cameras(const std::string& folder, Encoding encoding);
std::vector<ImageRecord> read_images(const std::string& folder, Encoding encoding);
// Calls `visit` for every point in the order of the file: a model may hold more than fit into memory.
void read_points(const std::string& path, Encoding encoding, const std::function<void(const PointRecord&)>& visit);

// The implementations, one file for each encoding.
std::vector<CameraRecord> read_cameras_text(const std::string& path);
std::vector<ImageRecord> read_images_text(const std::string& path);
void read_points_text(const std::string& path, const std::function<void(const PointRecord&)>& visit);
std::vector<CameraRecord> read_cameras_binary(const std::string& path);
std::vector<ImageRecord> read_images_binary(const std::string& path);
void read_points_binary(const std::string& path, const std::function<void(const PointRecord&)>& visit);

}  // namespace skysweep::formats::colmap
