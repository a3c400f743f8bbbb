// SPDX-License-Identifier: Apache-2.0
#include "watch/followed_folder.h"

#include <algorithm>
#include <utility>

#include "raster/file_stamp.h"
#include "watch/file_kind.h"

namespace skysweep::watch {
namespace {

constexpr double kLooksApart_s = 1;   // two looks that settle what no event told
constexpr double kSafetyLook_s = 30;  // beside events, in case one was lost

}  // namespace

FollowedFolder::FollowedFolder(std::filesystem::path folder, std::function<std::unique_ptr<FolderEvents>()> open_events,
                               std::function<double()> now_s, std::optional<double> poll_s)
    : folder_(std::move(folder)), open_events_(std::move(open_events)), now_s_(std::move(now_s)) {
  open(poll_s);
}

void FollowedFolder::open(std::optional<double> poll_s) {
  poll_s_ = poll_s;
  events_ = poll_s_ ? nullptr : open_events_();
  if (!events_) events_ = no_events();
  had_events_ = events_->tells();
  looks_to_go_ = 2;
  next_look_s_ = now_s_();
}

double FollowedFolder::look_interval() const {
  if (poll_s_) return *poll_s_;
  return events_->tells() && looks_to_go_ == 0 ? kSafetyLook_s : kLooksApart_s;
}

void FollowedFolder::take_in(double at_most_s) {
  for (const FileEvent& event : events_->wait(std::clamp(next_look_s_ - now_s_(), 0.0, at_most_s))) take_in(event);
  if (now_s_() >= next_look_s_) look();
}

void FollowedFolder::take_in(const FileEvent& event) {
  if (event.kind == FileEvent::Kind::lost) {
    looks_to_go_ = 2;
    next_look_s_ = std::min(next_look_s_, now_s_());
    return;
  }
  const FileKind kind = file_kind(event.name);
  if (kind == FileKind::other) return;
  if (event.kind == FileEvent::Kind::gone) return arrivals_.gone(event.name);
  if (kind == FileKind::poses) pose_files_.insert(event.name);
  if (event.kind == FileEvent::Kind::written) return arrivals_.written(event.name);
  if (const auto stamp = raster::file_stamp(folder_ / event.name)) arrivals_.closed(event.name, *stamp);
}

bool FollowedFolder::lost_all(const FolderLook& found) const {
  const auto is_photograph = [](const auto& file) { return file_kind(file.first) == FileKind::photograph; };
  return arrivals_.knows_photographs() && std::none_of(found.begin(), found.end(), is_photograph);
}

void FollowedFolder::look() {
  const std::optional<FolderLook> found = look_at_folder(folder_);
  const bool is_there = found && !lost_all(*found);
  if (!is_there) {
    away_ = "The folder " + folder_.string() + (found ? " holds no photograph any more" : " is not there") +
            ": the maps stay as they are until it is back.";
    looks_to_go_ = 2;
  } else {
    // Events of a folder that was away are those of another one.
    if (!away_.empty() || (had_events_ && !events_->tells())) open(poll_s_);
    away_.clear();
    arrivals_.look(*found);
    for (const auto& [name, stamp] : *found)
      if (file_kind(name) == FileKind::poses) pose_files_.insert(name);
    looks_to_go_ = std::max(0, looks_to_go_ - 1);
    is_known_ = is_known_ || looks_to_go_ == 0;
  }
  next_look_s_ = now_s_() + look_interval();
}

FollowedFolder::News FollowedFolder::take_news() { return {arrivals_.take_changes(), std::exchange(pose_files_, {})}; }

}  // namespace skysweep::watch
