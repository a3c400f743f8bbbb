// SPDX-License-Identifier: Apache-2.0
// A folder as a watcher sees it: events and looks together say which files are complete and whether it is there at all.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "watch/arrivals.h"
#include "watch/folder_events.h"

namespace skysweep::watch {

class FollowedFolder {
 public:
  // `open_events` gives null where there are none; `now_s` is a clock that only goes forward. With `poll_s` the folder
  // is looked at so often and no events are asked for; else it is looked at twice a second apart when that says more
  // than events do (at the start, when some were lost), and every half minute in case one was.
  FollowedFolder(std::filesystem::path folder, std::function<std::unique_ptr<FolderEvents>()> open_events,
                 std::function<double()> now_s, std::optional<double> poll_s);

  // From the beginning, but what is known stays known.
  void open(std::optional<double> poll_s);

  // Waits for something to happen until the next look is due, at most `at_most_s`, and takes in what did.
  void take_in(double at_most_s);

  // Since the last call. `pose_files`: files that may grow and have been seen, complete or not.
  struct News {
    Arrivals::Changes files;
    std::set<std::string> pose_files;
  };
  News take_news();

  // A sentence while the folder is not there, or has lost all its photographs at once: a disk that went away.
  const std::string& away() const { return away_; }
  // What lay there when it was first opened has been taken in.
  bool is_known() const { return is_known_; }
  // Nothing is about to become complete.
  bool is_settled() const { return looks_to_go_ == 0 && arrivals_.unsettled() == 0; }
  bool is_arriving(const std::string& name) const { return arrivals_.is_arriving(name); }
  int arriving() const { return arrivals_.unsettled(); }
  bool has_events() const { return events_->tells(); }

 private:
  void take_in(const FileEvent& event);
  void look();
  bool lost_all(const FolderLook& found) const;
  double look_interval() const;

  const std::filesystem::path folder_;
  const std::function<std::unique_ptr<FolderEvents>()> open_events_;
  const std::function<double()> now_s_;
  std::optional<double> poll_s_;
  std::unique_ptr<FolderEvents> events_;
  bool had_events_ = false;
  Arrivals arrivals_;
  std::set<std::string> pose_files_;
  std::string away_;
  bool is_known_ = false;
  int looks_to_go_ = 2;
  double next_look_s_ = 0;
};

}  // namespace skysweep::watch
