// SPDX-License-Identifier: Apache-2.0
// cameras.bin, images.bin and points3D.bin.
#include <cmath>

#include "core/error.h"
#include "formats/colmap/binary_reader.h"
#include "formats/colmap/camera_models.h"
#include "formats/colmap/records.h"

namespace skysweep::formats::colmap {
namespace {

// Sizes in bytes of what is skipped, and the least that a record takes.
constexpr std::uint64_t kCameraBytes = 4 + 4 + 8 + 8;
constexpr std::uint64_t kImageBytes = 4 + 4 * 8 + 3 * 8 + 4 + 1 + 8;
constexpr std::uint64_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr std::uint64_t kObservationBytes = 8 + 8 + 8;
constexpr std::uint64_t kTrackElementBytes = 4 + 4;

// "image 3" of the file, counted from one.
std::string ordinal(const char* what, std::uint64_t index) {
  return std::string(what) + ' ' + std::to_string(index + 1);
}

Vec3d read_vector(BinaryReader& file) {
  const double x = file.read<double>(), y = file.read<double>(), z = file.read<double>();
  return {x, y, z};
}

}  // namespace

std::vector<CameraRecord> read_cameras_binary(const std::string& path) {
  BinaryReader file(path);
  const std::uint64_t count = file.read_count(kCameraBytes, "cameras");
  std::vector<CameraRecord> cameras;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.set_record(ordinal("camera", i));
    CameraRecord camera;
    camera.where = file.where();
    camera.id = file.read<std::uint32_t>();
    const auto model_id = file.read<std::int32_t>();
    const CameraModelKind* kind = camera_model_by_id(model_id);
    if (!kind)
      throw bad_input(file.where() + ": the camera model number " + std::to_string(model_id) +
                      " is unknown, so the rest of the file cannot be read; " + supported_camera_models());
    camera.model = kind->name;
    camera.width_px = file.read<std::uint64_t>();
    camera.height_px = file.read<std::uint64_t>();
    for (int k = 0; k < kind->parameter_count; ++k) camera.parameters.push_back(file.read<double>());
    cameras.push_back(std::move(camera));
  }
  file.require_end();
  return cameras;
}

std::vector<ImageRecord> read_images_binary(const std::string& path) {
  BinaryReader file(path);
  const std::uint64_t count = file.read_count(kImageBytes, "images");
  std::vector<ImageRecord> images;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.set_record(ordinal("image", i));
    ImageRecord image;
    image.where = file.where();
    file.read<std::uint32_t>();  // image id: poses are known by name
    for (double& q : image.cam_from_world_wxyz) q = file.read<double>();
    image.translation = read_vector(file);
    image.camera_id = file.read<std::uint32_t>();
    image.name = file.read_name();
    const std::uint64_t observations = file.read_count(kObservationBytes, "observations");
    file.skip(observations, kObservationBytes);
    images.push_back(std::move(image));
  }
  file.require_end();
  return images;
}

void read_points_binary(const std::string& path, const std::function<void(const PointRecord&)>& visit) {
  BinaryReader file(path);
  const std::uint64_t count = file.read_count(kPointBytes, "points");
  for (std::uint64_t i = 0; i < count; ++i) {
    file.set_record(ordinal("point", i));
    PointRecord point;
    point.id = file.read<std::uint64_t>();
    point.position = read_vector(file);
    file.skip(3, 1);  // colour
    point.reprojection_error_px = file.read<double>();
    point.track_length = file.read_count(kTrackElementBytes, "observations");
    file.skip(point.track_length, kTrackElementBytes);
    if (!is_finite(point.position) || !std::isfinite(point.reprojection_error_px))
      throw bad_input(file.where() + ": its position or error is not a finite number.");
    visit(point);
  }
  file.require_end();
}

}  // namespace skysweep::formats::colmap
