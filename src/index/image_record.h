// SPDX-License-Identifier: Apache-2.0
// What the index knows about one photograph.
#pragma once

#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/box.h"

namespace skysweep::index {

enum class ImageStatus {
  used,     // serves matching
  oblique,  // usable, but looks too far from nadir to be matched
  refused,  // cannot be used: see reason
  removed,  // left out because the user said so (`run --remove`)
};

struct ImageRecord {
  std::string name;  // relative to the image folder; unique in a catalogue and its order everywhere
  camera::CameraModel model;
  camera::Pose pose;  // map coordinates
  camera::ViewClass view_class = camera::ViewClass::vertical;
  std::vector<Vec2d> footprint;  // on the ground, counter-clockwise; empty if unknown
  ImageStatus status = ImageStatus::used;
  std::string reason;          // a sentence when the status is not `used`
  std::string content_digest;  // of the file's bytes
  long long file_bytes = 0;
  std::string stamp;  // size and times of the file (raster::file_stamp) when the digest was taken; empty: look again

  friend bool operator==(const ImageRecord&, const ImageRecord&) = default;
};

// A refused photograph may have no pose and no camera: model.width_px == 0 then.

const char* to_string(ImageStatus status);

}  // namespace skysweep::index
