// SPDX-License-Identifier: Apache-2.0
#include "watch/status_board.h"

#include <cmath>

#include "core/error.h"
#include "raster/atomic_file.h"

namespace skysweep::watch {
namespace {

constexpr double kStageInterval_s = 1, kLifeSign_s = 10;
constexpr std::size_t kMostWarned = 10000;

}  // namespace

Status StatusBoard::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void StatusBoard::set(Status status) {
  const std::lock_guard lock(mutex_);
  status.stage = status_.stage;
  status.stage_done = status_.stage_done;
  status.stage_total = status_.stage_total;
  changed_ = changed_ || status_json(status, 0) != status_json(status_, 0);
  status_ = std::move(status);
}

void StatusBoard::end_of_batch() {
  const std::lock_guard lock(mutex_);
  status_.stage.clear();
  status_.stage_done = status_.stage_total = 0;
  changed_ = true;
}

void StatusBoard::write_if_due() {
  Status status;
  {
    const std::lock_guard lock(mutex_);
    const double age_s = std::abs(time_s_() - written_s_);  // a clock set back must not stop it
    if (!changed_ && age_s < kLifeSign_s && !(stage_changed_ && age_s >= kStageInterval_s)) return;
    status = status_;
    changed_ = stage_changed_ = false;
    written_s_ = time_s_();
  }
  write(status);
}

void StatusBoard::write() { write(status()); }

void StatusBoard::write(const Status& status) {
  const std::lock_guard lock(writing_);
  try {
    raster::write_bytes_atomically(file_, status_json(status, time_s_()));
  } catch (const Error& error) {
    warn(error.what());
  }
}

void StatusBoard::begin(const std::string& stage, int total) {
  {
    const std::lock_guard lock(mutex_);
    status_.stage = stage;
    status_.stage_done = 0;
    status_.stage_total = total;
    stage_changed_ = true;
  }
  progress_.begin(stage, total);
  write_if_due();
}

void StatusBoard::advance() {
  {
    const std::lock_guard lock(mutex_);
    ++status_.stage_done;
    stage_changed_ = true;
  }
  progress_.advance();
  write_if_due();
}

void StatusBoard::warn(const std::string& sentence) {
  bool is_new = false;
  {
    const std::lock_guard lock(mutex_);
    if (warned_.size() >= kMostWarned) warned_.clear();
    is_new = warned_.insert(sentence).second;
  }
  is_new ? progress_.warn(sentence) : progress_.note(sentence);
}

}  // namespace skysweep::watch
