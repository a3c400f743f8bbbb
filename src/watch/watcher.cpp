// SPDX-License-Identifier: Apache-2.0
#include "watch/watcher.h"

#include <sys/stat.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "formats/time_taken.h"
#include "pipeline/project.h"
#include "pipeline/project_lock.h"
#include "raster/atomic_file.h"
#include "raster/photo.h"
#include "watch/file_kind.h"
#include "watch/followed_folder.h"
#include "watch/group_map.h"
#include "watch/pose_book.h"
#include "watch/quarantine.h"
#include "watch/status_board.h"

namespace skysweep::watch {
namespace {

namespace fs = std::filesystem;

constexpr double kTick_s = 1;            // a signal that comes in just before a wait is seen after so long
constexpr double kRetry_s = 10;          // after a full disk, a locked project, a folder that went away
constexpr double kQuiet_s = 10;          // before mosaics are written: more may be on its way
constexpr double kHeld_s = 10;           // a batch waits for a photograph that is being sent again
constexpr std::size_t kMeasured = 1000;  // photographs whose waiting counts in the median

struct Photo {
  std::string problem;            // why the file cannot be used; empty if it can
  double complete_s = 0;          // since 1970, as all times here
  std::optional<double> posed_s;  // at the latest: its pose came between two looks at the poses
  std::optional<double> taken_s;  // for grouping by time
};

// When both the photograph and its pose were there.
double time_of_readiness(const Photo& photo) { return std::max(photo.complete_s, photo.posed_s.value_or(0)); }

// When the file got the bytes it has, as far as this watcher can know.
double time_of_change(const fs::path& path, double earliest_s, double now_s) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return now_s;
  const double changed_s =
      static_cast<double>(found.st_ctim.tv_sec) + 1e-9 * static_cast<double>(found.st_ctim.tv_nsec);
  return std::clamp(changed_s, std::min(earliest_s, now_s), now_s);
}

std::string text_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const fs::path& sensible_root(const WatchRequest& request) {
  require_sensible_folders(request);
  return request.run.project;
}

std::optional<fs::path> given_poses(const pipeline::RunRequest& run) {
  if (run.poses.empty()) return std::nullopt;
  return run.poses;
}

}  // namespace

struct Watcher::State {
  State(WatchRequest r, Surroundings s)
      : request(std::move(r)),
        around(std::move(s)),
        folder(request.run.images),
        root(request.run.project),
        settings(effective_settings(request)),
        lock(sensible_root(request)),
        board(root / "status.json", around.progress, around.time_s),
        followed(folder, around.open_events, around.now_s, settings.poll_s),
        poses(folder, given_poses(request.run)),
        grouping(settings.group, settings.gap()),
        started_s(around.time_s()) {
    grouping.restore(text_of_file(groups_file()));
    quarantine_written = text_of_file(quarantine_file());
  }

  fs::path groups_file() const { return root / "groups.csv"; }
  fs::path quarantine_file() const { return root / "quarantine.csv"; }

  // ---- what arrives

  void examine_changes() {
    const FollowedFolder::News news = followed.take_news();
    for (const std::string& name : news.pose_files) poses.arrived(name);
    for (const std::string& name : news.files.gone) forget(name);
    for (const std::string& name : news.files.complete) examine(name);
    if (!followed.away().empty()) board.warn(followed.away());
  }

  void forget(const std::string& name) {
    poses.gone(name);
    if (photos.erase(name) == 0) return;
    changed = true;
  }

  void examine(const std::string& name) {
    if (file_kind(name) != FileKind::photograph) return poses.arrived(name);
    Photo photo;
    const fs::path path = folder / name;
    photo.complete_s = time_of_change(path, started_s, around.time_s());
    try {
      raster::require_whole_photo(path);
      if (settings.group == GroupRule::time)
        if (const auto taken = formats::time_taken(path))
          photo.taken_s = std::chrono::duration<double>(taken->time_since_epoch()).count();
    } catch (const Error& error) {
      photo.problem = error.what();
    }
    photos[name] = photo;  // without posed_s: what was sent again is on its way again
    touched.insert(name);
    changed = true;
  }

  // ---- who belongs together

  void regroup() {
    std::vector<std::string> usable;
    for (const auto& [name, photo] : photos)
      if (photo.problem.empty()) usable.push_back(name);
    pairing = poses.pair(usable);
    // Those that have a group first: who is new may belong to one of them.
    std::stable_partition(usable.begin(), usable.end(), [&](const std::string& name) { return grouping.knows(name); });
    without_time.clear();
    for (const std::string& name : usable) {
      const auto posed = pairing.posed.find(name);
      if (posed == pairing.posed.end()) continue;
      if (Photo& photo = photos[name]; !photo.posed_s) photo.posed_s = looked_at_poses_s;
      const Vec3d center = posed->second.pose.center + request.run.origin;
      if (!grouping.place({name, photos[name].taken_s, center}))
        without_time[name] = (folder / name).string() +
                             " does not say when it was taken (EXIF DateTimeOriginal), and photographs are grouped by "
                             "time: use another --group.";
    }
    share_out();
    touched.clear();
    changed = false;
    last_change_s = around.now_s();
  }

  void share_out() {
    std::map<std::string, std::map<std::string, formats::PosedImage>> members;
    for (const auto& [name, image] : pairing.posed)
      if (!without_time.contains(name)) members[grouping.group_of(name)][name] = image;
    for (const auto& [name, images] : members)
      if (!groups.contains(name)) groups[name].has_project = pipeline::project_exists(project_paths(name));
    for (auto& [name, group] : groups) {
      if (!members.contains(name) && !group.members.empty()) group.left_because = why_left(name, group);
      group.set_members(std::move(members[name]), touched);
    }
    write_if_other(groups_file(), grouping.text(), groups_written);
  }

  // Of a group all of whose members have gone.
  std::string why_left(const std::string& name, const GroupMap& group) const {
    const std::string now = grouping.group_of(group.members.begin()->first);
    return now == name ? "Its photographs have gone." : "Its photographs became part of " + now + ".";
  }

  pipeline::ProjectPaths project_paths(const std::string& group) const { return pipeline::ProjectPaths(root / group); }

  // ---- maps

  int first() const { return request.once ? 0 : settings.first; }

  std::map<std::string, GroupMap>::iterator next_ready() {
    // The one that has waited longest, so that a busy group keeps nobody out.
    auto next = groups.end();
    // A map of what arrived before the rest was known would lose that rest.
    const bool may_begin = followed.is_known() && followed.away().empty();
    for (auto it = groups.begin(); may_begin && it != groups.end(); ++it)
      if (it->second.ready(first(), around.now_s()) && !held(it->second) &&
          (next == groups.end() || it->second.last_batch < next->second.last_batch))
        next = it;
    return next;
  }

  // While a photograph of the map is being sent again its tiles would be made without it. A sender that never comes to
  // an end does not hold the others up for ever.
  bool held(GroupMap& group) {
    const bool resent = std::any_of(group.members.begin(), group.members.end(),
                                    [&](const auto& member) { return followed.is_arriving(member.first); });
    if (!resent) {
      group.held_since_s.reset();
      return false;
    }
    if (!group.held_since_s) group.held_since_s = around.now_s();
    return around.now_s() - *group.held_since_s < kHeld_s;
  }

  std::map<std::string, GroupMap>::iterator next_unfinished() {
    if (!request.once && around.now_s() - last_change_s < kQuiet_s) return groups.end();
    return std::find_if(groups.begin(), groups.end(), [](const auto& g) { return g.second.unfinished.has_value(); });
  }

  bool has_work() { return next_ready() != groups.end() || next_unfinished() != groups.end(); }

  void map(const std::string& name, GroupMap& group, const std::atomic<bool>& stop) {
    pipeline::RunRequest run = request_for(group, name, request.run);
    if (settings.memory_bytes) run.memory_bytes = settings.memory_bytes;
    if (settings.threads) run.threads = *settings.threads;
    mapping = name;
    group.last_batch = ++begun;
    publish();
    try {
      take_over(group, run, around.mapper.update(run, board, stop));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::usage || (request.once && error.kind() == ErrorKind::failed)) throw;
      group.trouble = error.what();
      board.warn(name + ": " + error.what());
      // What is wrong with the photographs does not change by waiting.
      group.stale = error.kind() == ErrorKind::failed;
      if (group.stale) group.retry_s = around.now_s() + kRetry_s;
    }
    mapping.clear();
    board.end_of_batch();
  }

  void take_over(GroupMap& group, const pipeline::RunRequest& run, pipeline::RunSummary summary) {
    group.has_project = true;
    group.trouble.clear();
    group.tiles_computed += summary.tiles_computed;
    if (summary.interrupted) return;
    ++batches;
    group.refused.clear();
    for (const index::ImageRecord& image : summary.images)
      if (image.status == index::ImageStatus::refused) group.refused[image.name] = image.reason;
    const double now_s = around.time_s();
    for (const std::string& photograph : group.due)
      if (!group.refused.contains(photograph))
        waited_s.push_back(std::max(0.0, now_s - time_of_readiness(photos[photograph])));
    while (waited_s.size() > kMeasured) waited_s.pop_front();
    group.due.clear();
    group.stale = false;
    group.mapped = true;
    group.unfinished.emplace(run, std::move(summary));
  }

  void finish(const std::string& name, GroupMap& group) {
    const auto last = std::move(*group.unfinished);
    group.unfinished.reset();
    try {
      around.mapper.finish(last.first, last.second);
    } catch (const Error& error) {
      if (request.once) throw;
      group.trouble = error.what();
      board.warn(name + ": " + error.what());
      group.stale = true;  // everything is looked at again, and the mosaics with it
      group.retry_s = around.now_s() + kRetry_s;
    }
  }

  // ---- what others see

  std::map<std::string, std::string> quarantine() const {
    std::map<std::string, std::string> reasons = pairing.refused;
    for (const auto& [name, group] : groups) reasons.insert(group.refused.begin(), group.refused.end());
    reasons.insert(without_time.begin(), without_time.end());
    for (const auto& [name, photo] : photos)
      if (!photo.problem.empty()) reasons[name] = photo.problem;
    std::erase_if(reasons, [&](const auto& entry) { return !photos.contains(entry.first); });
    return reasons;
  }

  void write_if_other(const fs::path& file, const std::string& text, std::string& written) {
    if (text == written) return;
    try {
      raster::write_bytes_atomically(file, text);
      written = text;
    } catch (const Error& error) {
      board.warn(error.what());
    }
  }

  void publish() {
    const std::map<std::string, std::string> bad = quarantine();
    // After a start the old table stands until every file has been looked at again.
    if (followed.is_known() && next_ready() == groups.end())
      write_if_other(quarantine_file(), quarantine_text(bad), quarantine_written);
    Status s;
    s.state = !mapping.empty() ? "mapping " + mapping : followed.away().empty() ? "waiting" : followed.away();
    s.looks_by = followed.has_events() ? "events" : "polling";
    s.photographs = static_cast<int>(
        std::count_if(photos.begin(), photos.end(), [](const auto& photo) { return photo.second.problem.empty(); }));
    s.arriving = followed.arriving();
    s.waiting_for_pose = static_cast<int>(pairing.waiting.size());
    s.poses_waiting = static_cast<int>(pairing.poses_waiting);
    s.quarantined = static_cast<int>(bad.size());
    s.batches = batches;
    s.troubles = poses.problems();
    if (!followed.away().empty()) s.troubles.push_back(followed.away());
    if (!settings_trouble.empty()) s.troubles.push_back(settings_trouble);
    for (const auto& [name, group] : groups) {
      s.due += static_cast<int>(group.due.size());
      s.mapped += group.mapped_photographs();
      s.groups.push_back(group.status(name, first()));
      if (name == mapping) s.groups.back().state = "being mapped";
      if (!group.trouble.empty()) s.troubles.push_back(name + ": " + group.trouble);
    }
    if (!waited_s.empty()) {
      std::vector<double> sorted(waited_s.begin(), waited_s.end());
      std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
      s.median_seconds_to_tiles = sorted[sorted.size() / 2];
    }
    board.set(std::move(s));
    board.write_if_due();
  }

  WatchRequest request;
  Surroundings around;
  const fs::path folder, root;
  WatchSettings settings;
  pipeline::ProjectLock lock;
  StatusBoard board;
  FollowedFolder followed;
  PoseBook poses;
  Grouping grouping;
  std::map<std::string, Photo> photos;  // complete ones
  std::set<std::string> touched;        // since they were last grouped
  bool changed = true;                  // photographs or poses, since they were last grouped
  Pairing pairing;
  std::map<std::string, std::string> without_time;
  std::map<std::string, GroupMap> groups;
  std::string groups_written, quarantine_written;
  std::string mapping;  // the group in work
  std::string settings_trouble;
  std::deque<double> waited_s;
  long long batches = 0, begun = 0;
  double last_change_s = 0;
  const double started_s;
  double looked_at_poses_s = started_s;  // the time before the last, which poses read at the last may have come after
};

Watcher::Watcher(WatchRequest request, Surroundings surroundings)
    : state_(std::make_unique<State>(std::move(request), std::move(surroundings))) {}

Watcher::~Watcher() = default;

void Watcher::round(const std::atomic<bool>& stop) {
  State& s = *state_;
  s.followed.take_in(s.has_work() || stop ? 0 : kTick_s);
  s.examine_changes();
  const double looked_s = s.around.time_s();
  if (s.poses.refresh(s.around.now_s(), s.request.once)) s.changed = true;
  if (s.changed) s.regroup();
  s.looked_at_poses_s = looked_s;
  if (stop) return;
  if (const auto ready = s.next_ready(); ready != s.groups.end())
    s.map(ready->first, ready->second, stop);
  else if (const auto done = s.next_unfinished(); done != s.groups.end())
    s.finish(done->first, done->second);
  s.publish();
}

void Watcher::reload() {
  State& s = *state_;
  try {
    s.settings = effective_settings(s.request);
    s.settings_trouble.clear();
    s.grouping.use(s.settings.group, s.settings.gap());
  } catch (const Error& error) {
    s.settings_trouble = std::string(error.what()) + " The settings stay as they were.";
    s.board.warn(s.settings_trouble);
  }
  s.followed.open(s.settings.poll_s);
  for (auto& [name, photo] : s.photos)
    if (s.settings.group == GroupRule::time && !photo.taken_s) s.examine(name);
  for (auto& [name, group] : s.groups) {
    group.stale = true;
    group.retry_s = 0;
  }
  s.changed = true;
}

bool Watcher::idle() const {
  State& s = *state_;
  return s.followed.is_settled() && !s.changed && !s.has_work();
}

Status Watcher::status() const { return state_->board.status(); }
void Watcher::write_status() {
  state_->publish();
  state_->board.write();
}

void watch(Watcher& watcher, bool once, const std::atomic<bool>& stop, std::atomic<bool>& reload,
           const std::function<void()>& show) {
  while (!stop && !(once && watcher.idle())) {
    if (reload.exchange(false)) watcher.reload();
    watcher.round(stop);
    show();
  }
  watcher.write_status();
}

}  // namespace skysweep::watch
