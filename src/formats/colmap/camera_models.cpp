// SPDX-License-Identifier: Apache-2.0
#include "formats/colmap/camera_models.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"

namespace skysweep::formats::colmap {
namespace {

// In COLMAP's numbering, which is the index. Cameras of the unsupported ones are read past and refused one by one.
constexpr CameraModelKind kKinds[] = {{0, "SIMPLE_PINHOLE", 3},
                                      {1, "PINHOLE", 4},
                                      {2, "SIMPLE_RADIAL", 4},
                                      {3, "RADIAL", 5},
                                      {4, "OPENCV", 8},
                                      {5, "OPENCV_FISHEYE", 8},
                                      {6, "FULL_OPENCV", 12},
                                      {7, "FOV", 5},
                                      {8, "SIMPLE_RADIAL_FISHEYE", 4},
                                      {9, "RADIAL_FISHEYE", 5},
                                      {10, "THIN_PRISM_FISHEYE", 12},
                                      {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16}};

const CameraModelKind* kind_by_name(const std::string& name) {
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& k) { return k.name == name; });
  return found == std::end(kKinds) ? nullptr : found;
}

constexpr std::uint64_t kLargestSize = 1'000'000;  // pixels along one side

}  // namespace

const CameraModelKind* camera_model_by_id(int id) {
  return id >= 0 && id < static_cast<int>(std::size(kKinds)) ? &kKinds[id] : nullptr;
}

std::string supported_camera_models() {
  return "supported are SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and FULL_OPENCV with k4 = k5 = k6 = 0.";
}

camera::CameraModel to_camera_model(const CameraRecord& record) {
  const std::string& where = record.where;
  if (!record.problem.empty()) throw bad_input(record.problem);
  const CameraModelKind* kind = kind_by_name(record.model);
  if (!kind)
    throw bad_input(where + ": the camera model '" + record.model + "' is unknown; " + supported_camera_models());
  const std::vector<double>& p = record.parameters;
  if (p.size() != static_cast<std::size_t>(kind->parameter_count))
    throw bad_input(where + ": the camera model " + record.model + " has " + std::to_string(kind->parameter_count) +
                    " parameters, but " + std::to_string(p.size()) + " are given.");
  if (record.width_px > kLargestSize || record.height_px > kLargestSize)
    throw bad_input(where + ": the image size " + std::to_string(record.width_px) + " x " +
                    std::to_string(record.height_px) + " is absurd; the file is damaged.");

  camera::CameraModel model;
  model.width_px = static_cast<int>(record.width_px);
  model.height_px = static_cast<int>(record.height_px);
  const auto set_pinhole = [&model](double fx, double fy, double cx, double cy) {
    model.fx_px = fx, model.fy_px = fy, model.cx_px = cx, model.cy_px = cy;
  };
  if (record.model == "SIMPLE_PINHOLE") {
    set_pinhole(p[0], p[0], p[1], p[2]);
  } else if (record.model == "PINHOLE") {
    set_pinhole(p[0], p[1], p[2], p[3]);
  } else if (record.model == "SIMPLE_RADIAL") {
    set_pinhole(p[0], p[0], p[1], p[2]);
    model.distortion = {.k1 = p[3]};
  } else if (record.model == "RADIAL") {
    set_pinhole(p[0], p[0], p[1], p[2]);
    model.distortion = {.k1 = p[3], .k2 = p[4]};
  } else if (record.model == "OPENCV") {
    set_pinhole(p[0], p[1], p[2], p[3]);
    model.distortion = {.k1 = p[4], .k2 = p[5], .p1 = p[6], .p2 = p[7]};
  } else if (record.model == "FULL_OPENCV" && p[9] == 0 && p[10] == 0 && p[11] == 0) {
    set_pinhole(p[0], p[1], p[2], p[3]);
    model.distortion = {.k1 = p[4], .k2 = p[5], .p1 = p[6], .p2 = p[7], .k3 = p[8]};
  } else {
    throw bad_input(where + ": the camera model " + record.model +
                    " is not supported; undistort the photographs (colmap image_undistorter) or calibrate anew: " +
                    supported_camera_models());
  }
  if (const auto problem = model.problem()) throw bad_input(where + ": the camera cannot be used: " + *problem + ".");
  return model;
}

NamedParameters to_colmap(const camera::CameraModel& m) {
  const camera::Distortion& d = m.distortion;
  if (d.none()) return {"PINHOLE", {m.fx_px, m.fy_px, m.cx_px, m.cy_px}};
  if (d.k3 == 0) return {"OPENCV", {m.fx_px, m.fy_px, m.cx_px, m.cy_px, d.k1, d.k2, d.p1, d.p2}};
  return {"FULL_OPENCV", {m.fx_px, m.fy_px, m.cx_px, m.cy_px, d.k1, d.k2, d.p1, d.p2, d.k3, 0, 0, 0}};
}

}  // namespace skysweep::formats::colmap
