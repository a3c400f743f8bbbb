// SPDX-License-Identifier: Apache-2.0
// Keeps a watcher's status where others can read it, status.json among them, while batches report their progress.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "pipeline/progress.h"
#include "watch/status.h"

namespace skysweep::watch {

// Hands everything on to another Progress, a warning only the first time: every batch finds the same bad photographs.
class StatusBoard final : public pipeline::Progress {
 public:
  StatusBoard(std::filesystem::path file, pipeline::Progress& progress, std::function<double()> time_s)
      : file_(std::move(file)), progress_(progress), time_s_(std::move(time_s)) {}

  Status status() const;
  // All but the stage, which the batch in work reports.
  void set(Status status);
  void end_of_batch();
  // status.json, if something has changed or ten seconds have passed; a change of the stage counts once a second.
  void write_if_due();
  void write();

  void begin(const std::string& stage, int total) override;
  void advance() override;
  void note(const std::string& sentence) override { progress_.note(sentence); }
  void warn(const std::string& sentence) override;

 private:
  void write(const Status& status);

  const std::filesystem::path file_;
  pipeline::Progress& progress_;
  const std::function<double()> time_s_;
  mutable std::mutex mutex_;
  Status status_;
  bool changed_ = true;        // in more than its stage
  bool stage_changed_ = true;  // since it was written
  double written_s_ = 0;
  std::mutex writing_;
  std::set<std::string> warned_;
};

}  // namespace skysweep::watch
