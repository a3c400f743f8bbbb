// SPDX-License-Identifier: Apache-2.0
#include "formats/pose_set.h"

namespace skysweep::formats {

void add_origin(PoseSet& poses, Vec3d origin) {
  for (PosedImage& image : poses.images) image.pose.center = image.pose.center + origin;
}

}  // namespace skysweep::formats
