// SPDX-License-Identifier: Apache-2.0
// Ground control points as OpenDroneMap takes them: gcp_list.txt. The first line names the reference system
// ("EPSG:32632", or a PROJ string); each further line is one sighting of one point:
//
//   x y z pixel_x pixel_y image name
//
// In the file the centre of the top-left pixel is (0, 0), as OpenSfM counts; here it is (0.5, 0.5), as everywhere.
#pragma once

#include <string>
#include <vector>

#include "core/vec.h"

namespace skysweep::formats {

struct GroundControlPoint {
  struct Sighting {
    std::string image;
    Vec2d pixel;
  };
  std::string name;
  Vec3d position;  // in the file's reference system
  std::vector<Sighting> sightings;
};

struct GcpList {
  std::string crs;
  std::vector<GroundControlPoint> points;
};

// Throws Error(bad_input) for names with spaces, which the format cannot hold, and Error(failed) if the file cannot be
// written.
void write_gcp_list(const std::string& path, const GcpList& list);

// Lines of one name are one point; lines without a name are one point if their positions are equal. Throws
// Error(bad_input), naming file and line.
GcpList read_gcp_list(const std::string& path);

}  // namespace skysweep::formats
