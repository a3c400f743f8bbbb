// SPDX-License-Identifier: Apache-2.0
// Points of known position, against which a surface is measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"

namespace skysweep::formats {

struct CheckPoint {
  Vec3d position;  // metres
  std::string id;  // as the file has it; may be empty
};

// Which points of a COLMAP model are good enough to measure by. Surveyed points in a CSV know neither.
struct CheckPointFilter {
  std::optional<int> min_track_length;              // photographs that observe the point
  std::optional<double> max_reprojection_error_px;  // mean over its observations
};

// Reads check points from a CSV file with the columns x, y, z [, id], or from a COLMAP model: its folder or its
// points3D.txt or .bin. `origin` is added to every position. A check point that cannot be read is a mistake in the
// truth: Error(bad_input) names file and line. A filter for a CSV file is Error(usage).
std::vector<CheckPoint> read_check_points(const std::string& path, const CheckPointFilter& filter = {},
                                          Vec3d origin = {});

}  // namespace skysweep::formats
