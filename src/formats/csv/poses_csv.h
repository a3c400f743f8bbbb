// SPDX-License-Identifier: Apache-2.0
// The program's own pose file: image, x, y, z, a rotation and a camera per row. docs/input-formats.md describes it.
#pragma once

#include <string>

#include "formats/pose_set.h"

namespace skysweep::formats {

PoseSet read_poses_csv(const std::string& path);

}  // namespace skysweep::formats
