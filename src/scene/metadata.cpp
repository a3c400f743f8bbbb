// SPDX-License-Identifier: Apache-2.0
#include "scene/metadata.h"

#include <chrono>

#include "core/error.h"
#include "raster/crs.h"

namespace skysweep::scene {

void require_metadata_possible(const Scene& scene) {
  if (scene.metadata && scene.photographs.format == PhotoFormat::exr)
    throw usage_error("[metadata] has no effect on EXR photographs, which hold no EXIF tags: remove it");
}

std::vector<formats::PhotoMetadata> metadata_of(const Scene& scene, const std::vector<formats::PosedImage>& photographs,
                                                const std::string& crs, const std::string& software) {
  std::vector<formats::PhotoMetadata> out;
  if (!scene.metadata) return out;
  const Metadata& settings = *scene.metadata;
  std::vector<Vec2d> places;
  for (const formats::PosedImage& image : photographs) places.push_back({image.pose.center.x, image.pose.center.y});
  const auto positions = raster::wgs84_positions(crs, places);
  double way_m = 0;
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    const camera::Pose& pose = photographs[i].pose;
    if (i > 0) way_m += norm(pose.center - photographs[i - 1].pose.center);
    const camera::GimbalAngles gimbal = camera::yaw_pitch_roll_from_rotation(pose.cam_from_world);
    formats::PhotoMetadata& m = out.emplace_back();
    m.make = settings.make;
    m.model = settings.model;
    m.software = software;
    m.taken = settings.start + std::chrono::milliseconds(std::llround(1000 * way_m / settings.speed_mps));
    m.width_px = photographs[i].model.width_px;
    m.height_px = photographs[i].model.height_px;
    m.sensor_width_mm = settings.sensor_width_mm;
    m.focal_mm = photographs[i].model.focal_px() * settings.sensor_width_mm / m.width_px;
    if (positions) m.position = formats::GeoPosition{(*positions)[i].latitude_deg, (*positions)[i].longitude_deg};
    m.altitude_m = pose.center.z;
    m.relative_altitude_m = pose.center.z - scene.origin.z;
    m.gimbal_yaw_deg = gimbal.yaw_deg;
    m.gimbal_pitch_deg = gimbal.pitch_deg;
    m.gimbal_roll_deg = gimbal.roll_deg;
  }
  return out;
}

}  // namespace skysweep::scene
