// SPDX-License-Identifier: Apache-2.0
// How the pipeline tells what it is doing. Implemented by `app` (progress line, log) and by tests. Called from several
// threads at once.
#pragma once

#include <string>

namespace skysweep::pipeline {

class Progress {
 public:
  virtual ~Progress() = default;
  // A stage of `total` equal units begins.
  virtual void begin(const std::string& /*stage*/, int /*total*/) {}
  // One unit of the current stage is done.
  virtual void advance() {}
  // A sentence worth keeping (goes into the log), and one the user should see at once.
  virtual void note(const std::string& /*sentence*/) {}
  virtual void warn(const std::string& /*sentence*/) {}
};

}  // namespace skysweep::pipeline
