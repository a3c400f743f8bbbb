// SPDX-License-Identifier: Apache-2.0
// How many photographs have a place in their frame. What stands in between is not looked at.
#pragma once

#include <vector>

#include "camera/camera.h"
#include "core/box.h"

namespace skysweep::render {

class ViewCounts {
 public:
  // For places inside of `bounds`. Near ones are found through the R*-tree over the photographs' view pyramids, asked
  // once for each of 32 x 32 blocks.
  ViewCounts(std::vector<camera::Camera> cameras, const Box3d& bounds);

  int at(Vec3d place) const;
  int most() const { return most_; }  // at the middle of any block, halfway up

 private:
  static constexpr int kBlocks = 32;
  int block_of(Vec3d place) const;

  std::vector<camera::Camera> cameras_;
  Box3d bounds_;
  std::vector<std::vector<int>> near_;  // by block, row by row from the south-west
  int most_ = 0;
};

}  // namespace skysweep::render
