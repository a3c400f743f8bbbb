// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>

#include "app/commands/commands.h"
#include "app/commands/map_options.h"
#include "app/console.h"
#include "app/finish_run.h"
#include "app/interrupt.h"
#include "app/option_values.h"
#include "app/printable.h"
#include "core/error.h"
#include "pipeline/configuration.h"
#include "pipeline/project_lock.h"
#include "raster/crs.h"
#include "settings/preset.h"
#include "watch/folder_events.h"
#include "watch/metrics_server.h"
#include "watch/watcher.h"

namespace skysweep::app {
namespace {

using SteadyClock = std::chrono::steady_clock;

// As they stand on the command line.
struct WatchOptions {
  std::string folder, root, poses, group = "none";
  std::optional<std::string> settings;
  std::optional<double> gap, poll;
  std::optional<int> metrics;
  int first = watch::WatchSettings{}.first;
  MapOptions map;
  bool once = false, json_log = false;
};

watch::WatchRequest request_from(const WatchOptions& options) {
  watch::WatchRequest request;
  request.run.images = options.folder;
  request.run.project = options.root;
  request.run.poses = options.poses;
  apply(options.map, request.run);
  const auto rule = watch::group_rule_named(options.group);
  if (!rule) throw usage_error("--group takes none, folder, time or distance, not '" + options.group + "'.");
  request.settings.group = *rule;
  request.settings.group_gap = options.gap;
  request.settings.first = options.first;
  request.settings.poll_s = options.poll;
  if (options.settings) request.settings_file = *options.settings;
  request.once = options.once;
  if (options.metrics && (*options.metrics < 1 || *options.metrics > 65535))
    throw usage_error("--metrics takes a port from 1 to 65535.");
  // Found in the first second, not when the first photographs have come.
  if (request.run.crs) raster::crs_from_user_input(*request.run.crs);
  pipeline::read_configuration(request.run.preset.value_or(std::string(settings::kDefaultPreset)), request.run.config);
  return request;
}

// Maps as `run` makes them, with a log in each project.
class RunMapper final : public watch::Mapper {
 public:
  explicit RunMapper(Console& console) : console_(console) {}

  pipeline::RunSummary update(const pipeline::RunRequest& request, pipeline::Progress& progress,
                              const std::atomic<bool>& stop) override {
    const pipeline::ProjectLock lock(request.project);  // makes the folder, for the log
    const auto begun = SteadyClock::now();
    console_.log_to(pipeline::ProjectPaths(request.project).log());
    pipeline::RunSummary summary = pipeline::run(request, progress, stop);
    took_[request.project] = SteadyClock::now() - begun;
    return summary;
  }

  void finish(const pipeline::RunRequest& request, const pipeline::RunSummary& summary) override {
    const pipeline::ProjectLock lock(request.project);
    console_.log_to(pipeline::ProjectPaths(request.project).log());
    finish_run(request, summary, SteadyClock::now() - took_[request.project], console_);
  }

 private:
  Console& console_;
  std::map<std::filesystem::path, SteadyClock::duration> took_;  // the last update of each project
};

double seconds_now() { return std::chrono::duration<double>(SteadyClock::now().time_since_epoch()).count(); }

// One line on stderr: over and over on a terminal; in a log when it says something else, but not for every file.
class StatusLine {
 public:
  void show(const watch::Status& status, bool is_last = false) {
    const std::string line = printable(watch::status_line(status));
    const bool too_soon = !terminal_ && !is_last && status.state == state_ && seconds_now() - shown_s_ < kLogInterval_s;
    if (line == last_ || too_soon) return;
    last_ = line;
    state_ = status.state;
    shown_s_ = seconds_now();
    if (terminal_)
      std::fprintf(stderr, "\r\033[K%s", line.c_str());
    else
      std::fprintf(stderr, "skysweep watch: %s\n", line.c_str());
    std::fflush(stderr);
  }
  ~StatusLine() {
    if (terminal_ && !last_.empty()) std::fputs("\n", stderr);
  }

 private:
  static constexpr double kLogInterval_s = 10;
  const bool terminal_ = isatty(STDERR_FILENO) == 1;
  double shown_s_ = -kLogInterval_s;
  std::string last_, state_;
};

double time_now() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int watch_folder(const WatchOptions& options) {
  const watch::WatchRequest request = request_from(options);
  const std::atomic<bool>& stop = interrupt_requested();
  std::atomic<bool>& reload = reload_requested();
  Console console(options.json_log);
  RunMapper mapper(console);
  watch::Watcher watcher(
      request, {mapper, console, [&] { return watch::folder_events(request.run.images); }, seconds_now, time_now});
  std::optional<watch::MetricsServer> metrics;
  if (options.metrics) metrics.emplace(*options.metrics, [&] { return watch::prometheus_text(watcher.status()); });
  StatusLine line;
  watch::watch(watcher, options.once, stop, reload, [&] { line.show(watcher.status()); });
  line.show(watcher.status(), true);
  return 0;
}

}  // namespace

void add_watch_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand(
      "watch", "Follow a folder and keep maps up to date with the photographs that arrive in it.");
  auto o = std::make_shared<WatchOptions>();
  command->add_option("DIR", o->folder, "Folder in which photographs and poses arrive; subfolders are watched, too")
      ->required();
  command->add_option("-o,--output", o->root, "Root folder: each group's project lies in a folder of it")->required();
  command->add_option("--poses", o->poses,
                      "Pose file that grows, or is replaced, instead of DIR/poses.csv and files beside photographs");
  command->add_option("--group", o->group,
                      "Which photographs make a map together: none (default), folder, time, distance");
  command->add_option(
      "--group-gap", o->gap,
      "A group ends where nothing is nearer: minutes (time, default 10), metres (distance, default 200)");
  command->add_option("--first", o->first, "Photographs that a group has before its map is begun (default 5)");
  command->add_option(
      "--poll", o->poll,
      "Look at the folder every so many seconds instead of waiting for events: for network file systems");
  command->add_option(
      "--settings", o->settings,
      "TOML file with a section [watch]: group, group_gap, first, poll_seconds, memory_mib, threads; read "
      "again at SIGHUP");
  command->add_option("--metrics", o->metrics, "Port of 127.0.0.1 on which Prometheus may ask");
  command->add_flag("--once", o->once, "Map what is there and end, whatever --first says");
  add_map_options(*command, o->map);
  command->add_flag("--json-log", o->json_log, "One JSON object a line instead of text");
  command->callback([o, &chosen] { chosen = [o] { return watch_folder(*o); }; });
}

}  // namespace skysweep::app
