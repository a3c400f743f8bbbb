// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <thread>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/option_values.h"
#include "core/error.h"
#include "pipeline/project.h"
#include "pipeline/tbb_executor.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace skysweep::app {
namespace {

struct SimulateOptions {
  std::string scene, folder;
  int threads = 0;
  bool explain = false;
};

// A line for each effect there is. scripts/fault_dials.py reads calls and seconds from it.
void explain_effects(const scene::Simulation& result, Console& console) {
  if (result.effects.empty()) return console.say("This program was built without effects.");
  console.say("Effects in the order in which they act; " + std::to_string(result.rays_per_pixel) + " rays a pixel:");
  char line[400];
  std::snprintf(line, sizeof line, "  %-20s  %-8s  %8s  %9s  %s", "effect", "stage", "calls", "thread s", "because of");
  console.say(line);
  for (const scene::EffectReport& effect : result.effects) {
    const bool ran = !effect.named_at.empty();
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.3f", effect.seconds);
    std::snprintf(line, sizeof line, "  %-20s  %-8s  %8s  %9s  %s", effect.name.c_str(), effect.stage.c_str(),
                  ran ? std::to_string(effect.calls).c_str() : "-", ran ? seconds : "-",
                  ran ? effect.named_at.c_str() : "not named: nothing runs");
    console.say(line);
  }
}

int simulate(const SimulateOptions& options) {
  if (options.threads < 0) throw usage_error("--threads must be a positive number.");
  const scene::Scene scene = scene::read_scene(options.scene);
  Console console(false);
  pipeline::TbbExecutor executor(
      options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  scene::SimulationOptions simulation;
  simulation.software = pipeline::software_name();
  simulation.begin = [&](int photographs, std::uint64_t bytes_to_come) {
    console.say(std::to_string(photographs) + " photographs to take; about " +
                memory_text(resident_memory() + bytes_to_come) + " of memory");
    console.begin("photographs and truth", photographs + 1);  // the clock of the time left starts here
  };
  simulation.progress = [&](int, int) { console.advance(); };
  const scene::Simulation result = scene::simulate(scene, options.folder, executor, simulation);
  char text[200];
  std::snprintf(text, sizeof text, "%d photographs, GSD %.4g m, truth in cells of %.4g m: %s", result.photographs,
                result.gsd_m, result.truth_cell_m, options.folder.c_str());
  console.say(text);
  if (options.explain) explain_effects(result, console);
  return 0;
}

}  // namespace

void add_simulate_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command =
      program.add_subcommand("simulate", "Photographs of a synthetic scene with exact poses and truth.");
  auto o = std::make_shared<SimulateOptions>();
  command->add_option("SCENE", o->scene, "Scene file (TOML); examples lie in config/scenes")->required();
  command->add_option("-o,--output", o->folder, "Folder for photographs, poses and truth")->required();
  command->add_option("--threads", o->threads, "Number of threads (default: all)");
  command->add_flag("--explain", o->explain,
                    "Say which effects ran, because of which line of the scene, and for how long");
  command->callback([o, &chosen] { chosen = [o] { return simulate(*o); }; });
}

}  // namespace skysweep::app
