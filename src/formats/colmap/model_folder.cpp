// SPDX-License-Identifier: Apache-2.0
#include "formats/colmap/model_folder.h"

#include <filesystem>
#include <map>

#include "core/error.h"
#include "formats/collect/pose_collector.h"
#include "formats/colmap/camera_models.h"

namespace skysweep::formats::colmap {
namespace {

namespace fs = std::filesystem;

std::string file_in(const std::string& folder, const char* stem, Encoding encoding) {
  return (fs::path(folder) / (std::string(stem) + (encoding == Encoding::text ? ".txt" : ".bin"))).string();
}

bool is_complete(const std::string& folder, Encoding encoding) {
  return fs::is_regular_file(file_in(folder, "cameras", encoding)) &&
         fs::is_regular_file(file_in(folder, "images", encoding));
}

// A camera of the model, or why it cannot be used.
struct Camera {
  camera::CameraModel model;
  std::string problem;
};

std::map<std::uint32_t, Camera> usable_cameras(const std::vector<CameraRecord>& records) {
  std::map<std::uint32_t, Camera> cameras;
  for (const CameraRecord& record : records) {
    Camera camera;
    try {
      camera.model = to_camera_model(record);
    } catch (const Error& error) {
      camera.problem = error.what();
    }
    const auto [first, is_new] = cameras.try_emplace(record.id, std::move(camera));
    if (!is_new)
      first->second.problem =
          record.where + ": camera " + std::to_string(record.id) + " is defined more than once; keep one of them.";
  }
  return cameras;
}

PosedImage to_posed_image(const ImageRecord& image, const std::map<std::uint32_t, Camera>& cameras) {
  if (!image.problem.empty()) throw bad_input(image.problem);
  const auto camera = cameras.find(image.camera_id);
  if (camera == cameras.end())
    throw bad_input(image.where + ": its camera " + std::to_string(image.camera_id) +
                    " is not in the model's cameras file.");
  if (!camera->second.problem.empty())
    throw bad_input(image.where + ": its camera cannot be used: " + camera->second.problem);
  const auto& q = image.cam_from_world_wxyz;
  const std::optional<Mat3d> rotation = camera::rotation_from_quaternion(q[0], q[1], q[2], q[3]);
  if (!rotation) throw bad_input(image.where + ": the quaternion (qw, qx, qy, qz) has not the length 1.");
  return {image.name, camera->second.model, {*rotation, -(transpose(*rotation) * image.translation)}, image.where};
}

}  // namespace

std::optional<Encoding> model_encoding(const std::string& folder) {
  if (is_complete(folder, Encoding::binary)) return Encoding::binary;
  if (is_complete(folder, Encoding::text)) return Encoding::text;
  return std::nullopt;
}

PoseSet read_model(const std::string& folder) {
  const std::optional<Encoding> encoding = model_encoding(folder);
  if (!encoding)
    throw bad_input(folder +
                    ": is no COLMAP model; cameras.txt and images.txt, or cameras.bin and images.bin, must "
                    "both be there.");
  PoseCollector collector(folder);
  if (encoding == Encoding::binary && is_complete(folder, Encoding::text))
    collector.note(folder + ": holds a binary and a text model; the binary one was read.");
  const auto cameras = usable_cameras(read_cameras(folder, *encoding));
  for (const ImageRecord& image : read_images(folder, *encoding)) {
    try {
      collector.add(to_posed_image(image, cameras));
    } catch (const Error& error) {
      collector.refuse(image.name, image.where, error.what());
    }
  }
  return std::move(collector).finish();
}

std::vector<CameraRecord> read_cameras(const std::string& folder, Encoding encoding) {
  const std::string path = file_in(folder, "cameras", encoding);
  return encoding == Encoding::text ? read_cameras_text(path) : read_cameras_binary(path);
}

std::vector<ImageRecord> read_images(const std::string& folder, Encoding encoding) {
  const std::string path = file_in(folder, "images", encoding);
  return encoding == Encoding::text ? read_images_text(path) : read_images_binary(path);
}

void read_points(const std::string& path, Encoding encoding, const std::function<void(const PointRecord&)>& visit) {
  encoding == Encoding::text ? read_points_text(path, visit) : read_points_binary(path, visit);
}

}  // namespace skysweep::formats::colmap
