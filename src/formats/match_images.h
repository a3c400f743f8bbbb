// SPDX-License-Identifier: Apache-2.0
// Pairs the photographs found in a folder with the poses of a file. A wrong pose is worse than none: what is not unique
// is refused.
#pragma once

#include <string>
#include <vector>

#include "formats/pose_set.h"

namespace skysweep::formats {

struct ImageMatch {
  std::string photo;     // as given
  std::size_t pose = 0;  // index into PoseSet::images
};

struct Unmatched {
  std::string name;
  std::string reason;     // a sentence
  bool is_absent = true;  // nothing of its name is known; else what is known cannot be used
};

struct ImageMatches {
  std::vector<ImageMatch> matches;             // in the order of the photographs' paths
  std::vector<Unmatched> photos_without_pose;  // likewise
  std::vector<Unmatched> poses_without_photo;  // in the order of the poses' names; refused poses are not repeated here
  std::vector<std::string> notes;
};

// `photos`: paths relative to the image folder, separated by '/', each once. A photograph takes the pose whose name is
// its path; else the one that shares its file name if no other photograph or pose does, with the same case first, then
// with any. A photograph whose pose was refused by the reader stays without one.
ImageMatches match_images(std::vector<std::string> photos, const PoseSet& poses);

}  // namespace skysweep::formats
