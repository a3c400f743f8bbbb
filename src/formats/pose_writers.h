// SPDX-License-Identifier: Apache-2.0
// Writes photographs with poses in the formats that `read_poses` reads. What is read back has the same names, the same
// cameras and, where positions are snapped, the same positions bit for bit; rotations pass through a unit quaternion
// and agree to about 1e-15.
#pragma once

#include <string>
#include <vector>

#include "core/color.h"
#include "core/vec.h"
#include "formats/pose_set.h"

namespace skysweep::formats {

// A point of a sparse model as it is written.
struct SparsePoint {
  struct Observation {
    std::size_t image = 0;  // index into the images written with it
    Vec2d pixel;
  };
  Vec3d position;
  Rgb8 color;
  std::vector<Observation> track = {};  // may be empty
};

// One row per image: quaternion and camera in pixels. Throws Error(failed) if the file cannot be written, and
// Error(bad_input) for a name that the format cannot hold.
void write_poses_csv(const std::string& path, const std::vector<PosedImage>& images);

// cameras.txt (one camera for each distinct model), images.txt and points3D.txt in `folder`, which is made if needed.
// Errors as above.
void write_colmap_text(const std::string& folder, const std::vector<PosedImage>& images,
                       const std::vector<SparsePoint>& points = {});

}  // namespace skysweep::formats
