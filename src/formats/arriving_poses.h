// SPDX-License-Identifier: Apache-2.0
// Poses that arrive while somebody is looking: a poses.csv that grows, and a small file beside each photograph.
#pragma once

#include <string>

#include "formats/pose_set.h"

namespace skysweep::formats {

// A poses.csv (docs/input-formats.md) to which somebody is adding lines: a last line without line break may be half a
// line and is left alone. Throws Error(bad_input) as `read_poses` does; a file without a whole row holds no images.
PoseSet read_growing_poses(const std::string& path);

// The pose of one photograph. `.csv`: a header and one line with the columns of a poses.csv; `.json`: one object whose
// keys are those columns. The column `image` may be left out; where it stands it must name the photograph's file.
// cameras.csv beside the file serves both. `photo` becomes the image's name. Throws Error(bad_input) with a sentence.
PosedImage read_pose_sidecar(const std::string& path, const std::string& photo);

}  // namespace skysweep::formats
