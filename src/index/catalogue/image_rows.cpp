// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue/image_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/check.h"
#include "core/error.h"
#include "index/catalogue/polygon.h"
#include "index/catalogue/schema.h"

namespace skysweep::index {
namespace {

using CameraNumbers = std::array<double, kCameraColumns.size()>;
using PoseNumbers = std::array<double, kPoseColumns.size()>;

CameraNumbers numbers_of(const camera::CameraModel& m) {
  const camera::Distortion& d = m.distortion;
  return {static_cast<double>(m.width_px),
          static_cast<double>(m.height_px),
          m.fx_px,
          m.fy_px,
          m.cx_px,
          m.cy_px,
          d.k1,
          d.k2,
          d.p1,
          d.p2,
          d.k3};
}

camera::CameraModel camera_of(const CameraNumbers& n) {
  return {static_cast<int>(n[0]), static_cast<int>(n[1]), n[2], n[3], n[4], n[5], {n[6], n[7], n[8], n[9], n[10]}};
}

PoseNumbers numbers_of(const camera::Pose& pose) {
  PoseNumbers n{pose.center.x, pose.center.y, pose.center.z};
  std::copy(pose.cam_from_world.m.begin(), pose.cam_from_world.m.end(), n.begin() + 3);
  return n;
}

camera::Pose pose_of(const PoseNumbers& n) {
  camera::Pose pose;
  pose.center = {n[0], n[1], n[2]};
  std::copy(n.begin() + 3, n.end(), pose.cam_from_world.m.begin());
  return pose;
}

// A refused photograph may have numbers that no column can hold (not a number); it is kept without them.
template <typename Numbers>
bool all_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

template <typename Columns, typename Numbers>
void put_numbers(OGRFeature& row, const Columns& columns, const Numbers& numbers) {
  for (std::size_t i = 0; i < columns.size(); ++i) row.SetField(columns[i], numbers[i]);
}

template <typename Numbers, typename Columns>
Numbers numbers_in(const OGRFeature& row, const Columns& columns) {
  Numbers numbers{};
  for (std::size_t i = 0; i < columns.size(); ++i) numbers[i] = row.GetFieldAsDouble(columns[i]);
  return numbers;
}

// The rows of `cameras`, to which rows are added as they are asked for.
class CameraTable {
 public:
  explicit CameraTable(GDALDataset& dataset) : layer_(*dataset.GetLayerByName("cameras")) {
    for (const OGRFeatureUniquePtr& row : layer_) ids_[numbers_in<CameraNumbers>(*row, kCameraColumns)] = row->GetFID();
  }

  GIntBig id_of(const CameraNumbers& numbers) {
    if (const auto known = ids_.find(numbers); known != ids_.end()) return known->second;
    const OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer_.GetLayerDefn()));
    put_numbers(*row, kCameraColumns, numbers);
    if (layer_.CreateFeature(row.get()) != OGRERR_NONE) return OGRNullFID;
    return ids_[numbers] = row->GetFID();
  }

 private:
  OGRLayer& layer_;
  std::map<CameraNumbers, GIntBig> ids_;
};

std::map<GIntBig, camera::CameraModel> cameras_by_id(GDALDataset& dataset) {
  std::map<GIntBig, camera::CameraModel> cameras;
  for (const OGRFeatureUniquePtr& row : *dataset.GetLayerByName("cameras"))
    cameras[row->GetFID()] = camera_of(numbers_in<CameraNumbers>(*row, kCameraColumns));
  return cameras;
}

void put_pose(OGRFeature& row, const camera::Pose& pose) {
  put_numbers(row, kPoseColumns, numbers_of(pose));
  const camera::Quaternion q = camera::quaternion_from_rotation(pose.cam_from_world);
  put_numbers(row, std::array{"qw", "qx", "qy", "qz"}, std::array{q.w, q.x, q.y, q.z});
  row.SetField("off_nadir_deg", camera::off_nadir_deg(pose));
}

void put_image(OGRFeature& row, const ImageRecord& image, CameraTable& cameras) {
  row.SetField("status", to_string(image.status));
  row.SetField("reason", image.reason.c_str());
  row.SetField("view_class", camera::to_string(image.view_class));
  row.SetField("digest", image.content_digest.c_str());
  row.SetField("file_bytes", static_cast<GIntBig>(image.file_bytes));
  row.SetField("stamp", image.stamp.c_str());
  if (const CameraNumbers numbers = numbers_of(image.model);
      !(image.model == camera::CameraModel{}) && all_finite(numbers)) {
    row.SetField("camera", cameras.id_of(numbers));
    row.SetField("focal_px", image.model.focal_px());
  }
  if (!(image.pose == camera::Pose{}) && all_finite(numbers_of(image.pose))) put_pose(row, image.pose);
  SKY_CHECK(image.footprint.empty() || image.footprint.size() >= 3);
  if (!image.footprint.empty()) row.SetGeometryDirectly(polygon_from(image.footprint).release());
}

template <typename Enum>
Enum enum_in(const OGRFeature& row, const char* column, std::initializer_list<Enum> values) {
  const std::string text = row.GetFieldAsString(column);
  for (const Enum value : values)
    if (text == to_string(value)) return value;
  throw bad_input(std::string("its column ") + column + " says \"" + text + "\"");
}

ImageRecord image_in(const OGRFeature& row, const std::map<GIntBig, camera::CameraModel>& cameras) {
  using camera::ViewClass;
  ImageRecord image;
  image.name = row.GetFieldAsString("name");
  image.status =
      enum_in(row, "status", {ImageStatus::used, ImageStatus::oblique, ImageStatus::refused, ImageStatus::removed});
  image.reason = row.GetFieldAsString("reason");
  image.view_class = enum_in(
      row, "view_class", {ViewClass::vertical, ViewClass::near_vertical, ViewClass::oblique, ViewClass::high_oblique});
  image.content_digest = row.GetFieldAsString("digest");
  image.file_bytes = row.GetFieldAsInteger64("file_bytes");
  image.stamp = row.GetFieldAsString("stamp");
  if (row.IsFieldSetAndNotNull(row.GetFieldIndex("camera"))) {
    const auto known = cameras.find(row.GetFieldAsInteger64("camera"));
    if (known == cameras.end()) throw bad_input("the camera of " + image.name + " is not in it");
    image.model = known->second;
  }
  if (row.IsFieldSetAndNotNull(row.GetFieldIndex(kPoseColumns.front())))
    image.pose = pose_of(numbers_in<PoseNumbers>(row, kPoseColumns));
  image.footprint = corners_of(row.GetGeometryRef());
  return image;
}

}  // namespace

void put_image_rows(GDALDataset& dataset, const std::vector<ImageRecord>& images) {
  CameraTable cameras(dataset);
  std::vector<std::string> names;
  for (const ImageRecord& image : images) names.push_back(image.name);
  put_rows(dataset, "images", names, [&](std::size_t i, OGRFeature& row) { put_image(row, images[i], cameras); });
}

void remove_unused_cameras(GDALDataset& dataset) {
  std::vector<GIntBig> unused;
  for_each_row(dataset, "SELECT fid FROM cameras WHERE fid NOT IN (SELECT camera FROM images WHERE camera IS NOT NULL)",
               [&](const OGRFeature& row) { unused.push_back(row.GetFID()); });
  OGRLayer& layer = *dataset.GetLayerByName("cameras");
  for (const GIntBig id : unused)
    if (layer.DeleteFeature(id) != OGRERR_NONE) return;
}

std::vector<ImageRecord> image_rows(GDALDataset& dataset) {
  const std::map<GIntBig, camera::CameraModel> cameras = cameras_by_id(dataset);
  std::vector<ImageRecord> images;
  for (const OGRFeatureUniquePtr& row : *dataset.GetLayerByName("images")) images.push_back(image_in(*row, cameras));
  return images;
}

}  // namespace skysweep::index
