// SPDX-License-Identifier: Apache-2.0
// What a person or a machine sees of a run: a progress line with done/total, rate, time left and memory on a terminal,
// plain lines when the output is no terminal, one JSON object a line with --json-log. Everything also goes into the
// project's log file once it is known where that is.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/progress.h"

namespace skysweep::app {

class Console final : public pipeline::Progress {
 public:
  explicit Console(bool json);
  ~Console() override;

  // From here on everything is appended to this file, too; what was said before is not lost.
  void log_to(const std::filesystem::path& file);

  void begin(const std::string& stage, int total) override;
  void advance() override;
  void note(const std::string& sentence) override;
  void warn(const std::string& sentence) override;

  // A line of the result, for people (with --json-log it becomes an event).
  void say(const std::string& line);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Resident memory of this process now, and its peak, in bytes.
std::size_t resident_memory();
std::size_t peak_resident_memory();

}  // namespace skysweep::app
