// SPDX-License-Identifier: Apache-2.0
// Poses from a reconstruction.json of OpenSfM or OpenDroneMap.
#pragma once

#include <string>

#include "formats/pose_set.h"

namespace skysweep::formats {

PoseSet read_opensfm(const std::string& path);

}  // namespace skysweep::formats
