// SPDX-License-Identifier: Apache-2.0
// COLMAP's camera models: all of them by number and name, and ours from those that are pinholes with Brown distortion.
#pragma once

#include <string>
#include <vector>

#include "camera/camera_model.h"
#include "formats/colmap/records.h"

namespace skysweep::formats::colmap {

struct CameraModelKind {
  int id;
  const char* name;
  int parameter_count;
};

// Null for a number that COLMAP has not given out.
const CameraModelKind* camera_model_by_id(int id);

// "supported are ..." for messages.
std::string supported_camera_models();

// Throws Error(bad_input) if the camera cannot be used.
camera::CameraModel to_camera_model(const CameraRecord& record);

// The simplest of COLMAP's models that holds this camera exactly.
struct NamedParameters {
  const char* model;
  std::vector<double> parameters;
};
NamedParameters to_colmap(const camera::CameraModel& model);

}  // namespace skysweep::formats::colmap
