// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "core/check.h"
#include "core/error.h"
#include "formats/colmap/camera_models.h"
#include "formats/pose_writers.h"
#include "formats/text/line_reader.h"
#include "formats/text/numbers.h"
#include "formats/text/text_file.h"

namespace skysweep::formats {
namespace {

std::vector<camera::CameraModel> distinct_cameras(const std::vector<PosedImage>& images) {
  std::vector<camera::CameraModel> cameras;
  for (const PosedImage& image : images)
    if (std::find(cameras.begin(), cameras.end(), image.model) == cameras.end()) cameras.push_back(image.model);
  return cameras;
}

// COLMAP counts cameras from one.
std::size_t camera_id(const std::vector<camera::CameraModel>& cameras, const camera::CameraModel& model) {
  return static_cast<std::size_t>(std::find(cameras.begin(), cameras.end(), model) - cameras.begin()) + 1;
}

std::string cameras_text(const std::vector<camera::CameraModel>& cameras) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const colmap::NamedParameters colmap_camera = colmap::to_colmap(cameras[i]);
    text += std::to_string(i + 1) + ' ' + colmap_camera.model + ' ' + std::to_string(cameras[i].width_px) + ' ' +
            std::to_string(cameras[i].height_px);
    for (const double value : colmap_camera.parameters) text += ' ' + exact_text(value);
    text += '\n';
  }
  return text;
}

// An observation stands twice in a model: at its image with pixel and point, at its point with image and place there.
struct Observations {
  std::vector<std::string> of_image;  // the line of each image
  std::vector<std::string> of_point;  // the track of each point
};

Observations observations_text(const std::vector<SparsePoint>& points, std::size_t image_count) {
  Observations out{std::vector<std::string>(image_count), {}};
  std::vector<int> counted(image_count);
  for (std::size_t point = 0; point < points.size(); ++point) {
    std::string track;
    for (const SparsePoint::Observation& seen : points[point].track) {
      SKY_CHECK_LT(seen.image, image_count);
      std::string& line = out.of_image[seen.image];
      if (!line.empty()) line += ' ';
      line += exact_text(seen.pixel.x) + ' ' + exact_text(seen.pixel.y) + ' ' + std::to_string(point + 1);
      track += ' ' + std::to_string(seen.image + 1) + ' ' + std::to_string(counted[seen.image]++);
    }
    out.of_point.push_back(std::move(track));
  }
  return out;
}

std::string images_text(const std::vector<PosedImage>& images, const std::vector<camera::CameraModel>& cameras,
                        const Observations& observations, const std::string& folder) {
  std::string text = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (std::size_t i = 0; i < images.size(); ++i) {
    const PosedImage& image = images[i];
    if (image.name.empty() || image.name.find_first_of("\r\n") != std::string::npos ||
        trimmed(image.name) != image.name)
      throw bad_input(folder + ": a COLMAP model cannot hold the image name '" + image.name +
                      "' (empty, with a line break, or with spaces at its ends); rename the photograph.");
    const camera::Quaternion q = camera::quaternion_from_rotation(image.pose.cam_from_world);
    const Vec3d t = -(image.pose.cam_from_world * image.pose.center);
    text += std::to_string(i + 1);
    for (const double value : {q.w, q.x, q.y, q.z, t.x, t.y, t.z}) text += ' ' + exact_text(value);
    text += ' ' + std::to_string(camera_id(cameras, image.model)) + ' ' + image.name + "\n" + observations.of_image[i] +
            "\n";
  }
  return text;
}

std::string points_text(const std::vector<SparsePoint>& points, const Observations& observations) {
  std::string text = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [position, color, track] = points[i];
    text += std::to_string(i + 1);
    for (const double value : {position.x, position.y, position.z}) text += ' ' + exact_text(value);
    for (const int value : {color.r, color.g, color.b}) text += ' ' + std::to_string(value);
    text += " 0" + observations.of_point[i] + "\n";
  }
  return text;
}

}  // namespace

void write_colmap_text(const std::string& folder, const std::vector<PosedImage>& images,
                       const std::vector<SparsePoint>& points) {
  const std::filesystem::path path = folder;
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw failure(folder + ": the folder cannot be made (" + error.message() + ").");
  const std::vector<camera::CameraModel> cameras = distinct_cameras(images);
  const Observations observations = observations_text(points, images.size());
  write_text_file((path / "cameras.txt").string(), cameras_text(cameras));
  write_text_file((path / "images.txt").string(), images_text(images, cameras, observations, folder));
  write_text_file((path / "points3D.txt").string(), points_text(points, observations));
}

}  // namespace skysweep::formats
