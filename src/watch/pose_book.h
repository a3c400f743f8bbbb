// SPDX-License-Identifier: Apache-2.0
// The poses that have arrived so far, from a poses.csv in any folder (which may grow) and from files beside
// photographs, and which photograph each belongs to, in whatever order both come.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/pose_set.h"

namespace skysweep::watch {

struct Pairing {
  std::map<std::string, formats::PosedImage> posed;  // photograph -> its pose, named for the photograph
  std::map<std::string, std::string> refused;        // photograph -> why the pose that is there cannot be used
  std::vector<std::string> waiting;                  // photographs whose pose has not come
  std::size_t poses_waiting = 0;                     // poses whose photograph has not come
};

class PoseBook {
 public:
  // `folder` is watched. With `pose_file` the poses come from it (any file `read_poses` takes) and not from poses.csv.
  PoseBook(std::filesystem::path folder, std::optional<std::filesystem::path> pose_file);

  // A file of the kind `poses` or `sidecar` is there, or has changed; or went. What it said before stays in force until
  // it says something else: a file that is being written anew must not take a map apart.
  void arrived(const std::string& name);
  void gone(const std::string& name);

  // Reads what has changed since the last call; true if there are other poses now. The last line of a growing file is
  // believed once it ends, or when the file has stood still for ten seconds, or with `believe_all`.
  bool refresh(double now_s, bool believe_all);

  // The rules of formats::match_images for all photographs together; a file beside a photograph goes before.
  Pairing pair(const std::vector<std::string>& photographs);

  // Pose files that cannot be read, a sentence each.
  std::vector<std::string> problems() const;

 private:
  struct PoseFile {
    std::filesystem::path path;
    std::string prefix;  // of its folder, before the names it holds
    std::string stamp;
    double since_s = 0;     // the stamp is the same
    bool read_all = false;  // with its last line
    std::map<std::string, formats::PosedImage> images;
    std::map<std::string, std::string> refused;
    std::string problem;
  };
  struct Sidecar {
    std::optional<formats::PosedImage> image;
    std::string problem;
  };
  static bool read(PoseFile& file, bool with_last_line);
  const Sidecar* sidecar_of(const std::string& photograph);

  std::filesystem::path folder_;
  bool only_one_;                          // pose_file was given
  std::map<std::string, PoseFile> files_;  // by name
  std::set<std::string> sidecars_;         // those that lie there
  std::map<std::string, Sidecar> read_;    // by photograph
  bool sidecars_changed_ = false;
};

}  // namespace skysweep::watch
