// SPDX-License-Identifier: Apache-2.0
// Photographs with poses as read from a file, whatever its format.
#pragma once

#include <string>
#include <vector>

#include "camera/camera_model.h"
#include "camera/pose.h"

namespace skysweep::formats {

struct PosedImage {
  std::string name;  // as the file names it: a path relative to the image folder, or a bare file name
  camera::CameraModel model;
  camera::Pose pose;  // in the file's frame; position snapped (camera::snap_position)
  std::string where;  // "poses.csv:12", for messages
};

struct RefusedImage {
  std::string name;
  std::string reason;  // a sentence that names file and line
};

struct PoseSet {
  std::vector<PosedImage> images;     // sorted by name, names unique, every model and pose usable
  std::vector<RefusedImage> refused;  // entries that cannot be used; the rest went on
  std::vector<std::string> notes;     // what the reader ignored or assumed, a sentence each
};

// Reads the poses from a poses.csv, a COLMAP model folder (text or binary) or an OpenSfM/ODM reconstruction.json: what
// it is, is told by looking. Throws Error(bad_input), naming file and line, if nothing in it can be trusted.
PoseSet read_poses(const std::string& path);

// Adds `origin` to every position: model coordinates -> map coordinates. Not snapped again: whoever takes the
// difference to a place nearby and snaps that (camera::Camera::relative_to) gets the same bits wherever the origin
// lies.
void add_origin(PoseSet& poses, Vec3d origin);

}  // namespace skysweep::formats
