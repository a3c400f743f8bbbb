// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <filesystem>
#include <iostream>

#include "app/commands/commands.h"
#include "app/printable.h"
#include "core/error.h"
#include "pipeline/project.h"

namespace {

constexpr int kUsage = 2;

int run_program(int argc, char** argv) {
  using namespace skysweep;
  CLI::App program("Surface models, true orthophotos and confidence maps from aerial photographs with poses.",
                   "skysweep");
  program.set_version_flag("--version", pipeline::software_name());
  program.require_subcommand(1);
  program.failure_message(CLI::FailureMessage::simple);
  app::ChosenCommand chosen;
  app::add_run_command(program, chosen);
  app::add_watch_command(program, chosen);
  app::add_info_command(program, chosen);
  app::add_evaluate_command(program, chosen);
  app::add_sweep_command(program, chosen);
  app::add_simulate_command(program, chosen);
  app::add_export_command(program, chosen);
  app::add_render_command(program, chosen);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : kUsage;  // 0: --help and --version
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const skysweep::Error& error) {
    std::cerr << "skysweep: " << skysweep::app::printable(error.what()) << "\n";
    return error.exit_code();
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "skysweep: " << skysweep::app::printable(error.what()) << "\n";
    return 1;
  } catch (const std::bad_alloc&) {
    std::cerr << "skysweep: out of memory; allow less with --memory, which plans before it starts.\n";
    return 4;
  }
}
