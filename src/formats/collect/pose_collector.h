// SPDX-License-Identifier: Apache-2.0
// Gathers the entries of a pose file into a PoseSet: the checks that are the same for every format.
#pragma once

#include <string>
#include <vector>

#include "formats/pose_set.h"

namespace skysweep::formats {

class PoseCollector {
 public:
  // `source`: the file or folder being read, for messages.
  explicit PoseCollector(std::string source) : source_(std::move(source)) {}

  // An entry as read. Its position is snapped; it is refused if it has no name or its camera or pose is unusable.
  void add(PosedImage image);
  // An entry that could not be read; `reason` begins with `where`.
  void refuse(std::string name, std::string where, std::string reason);
  void note(std::string sentence) { notes_.push_back(std::move(sentence)); }

  // Sorts by name and refuses every name that was met more than once: nobody can tell which of its poses is right.
  // Throws Error(bad_input) if not one entry is left.
  PoseSet finish() &&;

 private:
  struct Entry {
    PosedImage image;
    std::string reason;  // empty: usable
  };

  std::string source_;
  std::vector<Entry> entries_;
  std::vector<std::string> notes_;
};

}  // namespace skysweep::formats
