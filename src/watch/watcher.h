// SPDX-License-Identifier: Apache-2.0
// Follows a folder and keeps maps up to date with what arrives in it: a loop that finds complete photographs with
// poses, groups them, and brings each group's project up to date as `run` does. While a batch is in work arrivals queue
// up in the kernel, as names; they are the next batch.
//
// Not for several threads; pipeline and mapper may call the progress from any.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "pipeline/progress.h"
#include "pipeline/session.h"
#include "watch/folder_events.h"
#include "watch/status.h"
#include "watch/watch_request.h"

namespace skysweep::watch {

// Makes the maps.
class Mapper {
 public:
  virtual ~Mapper() = default;
  // As pipeline::run.
  virtual pipeline::RunSummary update(const pipeline::RunRequest& request, pipeline::Progress& progress,
                                      const std::atomic<bool>& stop) = 0;
  // Makes what people take away, when nothing more is to be done for the tiles.
  virtual void finish(const pipeline::RunRequest& request, const pipeline::RunSummary& summary) = 0;
};

struct Surroundings {
  Mapper& mapper;
  pipeline::Progress& progress;
  std::function<std::unique_ptr<FolderEvents>()> open_events;  // null: there are none
  std::function<double()> now_s;                               // of a clock that only goes forward
  std::function<double()> time_s;                              // since 1970
};

class Watcher {
 public:
  // Throws Error(usage) for settings that make no sense, folders that lie in one another, and a missing folder;
  // Error(failed) when another watcher has the root.
  Watcher(WatchRequest request, Surroundings surroundings);
  ~Watcher();

  // Waits for something to happen, at most a second, takes it in, and brings at most one group's map up to date.
  // Throws Error(usage) when a project contradicts what is asked for.
  void round(const std::atomic<bool>& stop);

  // Reads the settings file again and looks at everything anew. A file that is wrong is named and changes nothing.
  void reload();

  // Nothing to do until something arrives.
  bool idle() const;

  Status status() const;  // may be called from any thread
  void write_status();    // now, not when it is due

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Until `stop`, or with `once` until idle. `reload` is looked at between batches and taken back; `show` is called after
// every round.
void watch(Watcher& watcher, bool once, const std::atomic<bool>& stop, std::atomic<bool>& reload,
           const std::function<void()>& show);

}  // namespace skysweep::watch
