// SPDX-License-Identifier: Apache-2.0
// Where an export goes, whole or not at all: everything is written into a hidden folder beside it and takes its final
// name when it is complete and on the disk. An export that is killed leaves that folder behind and nothing under the
// final name; the next export to the same place removes it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skysweep::exports {

enum class DestinationKind { file, folder };

class Destination {
 public:
  // Throws Error(usage) if `path` exists and may not be replaced: without `overwrite` nothing may; with it a file may
  // by a file, and a folder by a folder if an export has made it (it holds labels.json). Throws Error(failed) if
  // nothing can be written there.
  Destination(std::filesystem::path path, DestinationKind kind, bool overwrite);
  ~Destination();
  Destination(const Destination&) = delete;
  Destination& operator=(const Destination&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // For what is needed on the way only.
  const std::filesystem::path& scratch() const { return scratch_; }
  // Where to write the result: a path with the final name, whose folder exists; a folder exists itself.
  std::filesystem::path result() const { return scratch_ / "result" / path_.filename(); }
  // Where to write a file that goes with the result, named like it with something appended: ".prj".
  std::filesystem::path side_file(const std::string& appended) const;

  // Puts what was written in its place: side files first, the result last. Throws Error(failed).
  void publish();

 private:
  std::filesystem::path path_;
  std::filesystem::path scratch_;
  DestinationKind kind_;
};

// The file that says of a folder that an export has made it.
inline constexpr const char* kLabelsFile = "labels.json";

}  // namespace skysweep::exports
