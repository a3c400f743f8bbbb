// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "app/commands/commands.h"
#include "app/commands/map_options.h"
#include "app/console.h"
#include "app/finish_run.h"
#include "app/interrupt.h"
#include "app/option_values.h"
#include "core/error.h"
#include "pipeline/project_lock.h"
#include "pipeline/session.h"
#include "raster/crs.h"

namespace skysweep::app {
namespace {

// The options as they stand on the command line.
struct RunOptions {
  std::string images, project, poses;
  MapOptions map;
  bool fresh = false, strict = false, dry_run = false, json_log = false;
  bool verify = false;
  std::vector<std::string> remove, restore;
};

pipeline::RunRequest request_from(const RunOptions& options) {
  pipeline::RunRequest request;
  request.images = options.images;
  request.poses = options.poses;
  request.project = options.project;
  apply(options.map, request);
  request.fresh = options.fresh;
  request.dry_run = options.dry_run;
  request.verify = options.verify;
  request.remove = options.remove;
  request.restore = options.restore;
  return request;
}

void say_plan(const pipeline::RunSummary& summary, Console& console) {
  const pipeline::ProjectSettings& s = summary.settings;
  const auto used = std::count_if(summary.images.begin(), summary.images.end(),
                                  [](const auto& image) { return image.status == index::ImageStatus::used; });
  console.say(std::to_string(used) + " of " + std::to_string(summary.images.size()) + " photographs would be used, " +
              std::to_string(summary.tiles_planned) + " tiles (" + std::to_string(summary.tiles_stale) +
              " to compute, " + std::to_string(summary.tiles_kept) + " up to date) of " +
              std::to_string(s.lattice.tile_cells) + " x " + std::to_string(s.lattice.tile_cells) + " cells of " +
              std::to_string(s.lattice.cell_m) + " m, plane step " + std::to_string(s.lattice.dz_m) + " m.");
  console.say("CRS: " + raster::crs_name(s.crs_wkt) + ". Heights: " + raster::vertical_reference(s.crs_wkt) + ".");
  console.say("Memory: up to " + memory_text(summary.memory.limit_bytes) + ", " +
              std::to_string(summary.memory.tiles_in_flight) + " tiles at a time, " +
              memory_text(summary.memory.photo_cache_bytes) + " of decoded photographs. Disk: at most " +
              memory_text(summary.disk_bytes_needed) + ". Nothing was written.");
}

int exit_code(const pipeline::RunSummary& summary, const RunOptions& options) {
  if (summary.interrupted) return kExitInterrupted;
  const bool refused = std::any_of(summary.images.begin(), summary.images.end(),
                                   [](const auto& image) { return image.status == index::ImageStatus::refused; });
  return options.strict && refused ? static_cast<int>(ErrorKind::bad_input) : 0;
}

int run(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const pipeline::RunRequest request = request_from(options);
  Console console(options.json_log);
  std::optional<pipeline::ProjectLock> lock;  // until the mosaics are written, too
  if (!request.dry_run) lock.emplace(request.project);
  const pipeline::RunSummary summary = pipeline::run(request, console, interrupt_requested());
  if (options.dry_run) {
    say_plan(summary, console);
    return exit_code(summary, options);
  }
  console.log_to(pipeline::ProjectPaths(request.project).log());
  finish_run(request, summary, start, console);
  return exit_code(summary, options);
}

}  // namespace

void add_run_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("run", "Make or continue a map from a folder of photographs with poses.");
  auto o = std::make_shared<RunOptions>();
  command->add_option("IMAGES", o->images, "Folder of photographs; subfolders are read, too")->required();
  command->add_option("-o,--output", o->project, "Project folder")->required();
  command
      ->add_option("--poses", o->poses,
                   "poses.csv, a COLMAP model folder (text or binary) or an OpenSfM/ODM reconstruction.json")
      ->required();
  add_map_options(*command, o->map);
  command->add_flag("--fresh", o->fresh, "Start over: throw away what the project folder holds");
  command->add_option("--remove", o->remove,
                      "Take the photographs that match this pattern out of the project, e.g. 'flight2/*'; their files "
                      "are left alone");
  command->add_option("--restore", o->restore, "Take photographs back that --remove took out");
  command->add_flag("--verify", o->verify,
                    "Read every photograph and every tile again instead of trusting sizes and times; what is damaged "
                    "is made anew");
  command->add_flag("--strict", o->strict, "End with exit code 3 if any photograph was refused");
  command->add_flag("--dry-run", o->dry_run, "Say what would be done and what it takes; write nothing");
  command->add_flag("--json-log", o->json_log, "One JSON object a line instead of text");
  command->callback([o, &chosen] { chosen = [o] { return run(*o); }; });
}

}  // namespace skysweep::app
