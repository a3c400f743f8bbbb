// SPDX-License-Identifier: Apache-2.0
// cameras.csv: the cameras that the rows of a poses.csv refer to by name.
#pragma once

#include <map>
#include <string>

#include "camera/camera_model.h"

namespace skysweep::formats {

class CameraTable {
 public:
  // Throws Error(bad_input) if the file cannot be read or its header declares no camera; a bad row costs only the
  // images that name it.
  explicit CameraTable(const std::string& path);

  // Throws Error(bad_input), beginning with `where`, if there is no such camera or it cannot be used.
  const camera::CameraModel& named(const std::string& name, const std::string& where) const;
  // The only camera of the table; throws as `named`, or if there are several.
  const camera::CameraModel& only(const std::string& where) const;

 private:
  struct Entry {
    camera::CameraModel model;
    std::string place;    // "cameras.csv:2"
    std::string problem;  // a sentence; empty: usable
  };
  static const camera::CameraModel& usable(const std::string& name, const Entry& entry, const std::string& where);

  std::string path_;
  std::map<std::string, Entry> cameras_;
};

}  // namespace skysweep::formats
