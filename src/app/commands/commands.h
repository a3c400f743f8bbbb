// SPDX-License-Identifier: Apache-2.0
// The commands of the program, one file each. `add_...` declares the command's options; when the command was given, the
// function it leaves behind runs it and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace skysweep::app {

// Set by the command that was given on the command line.
using ChosenCommand = std::function<int()>;

void add_run_command(CLI::App& program, ChosenCommand& chosen);
void add_info_command(CLI::App& program, ChosenCommand& chosen);
void add_evaluate_command(CLI::App& program, ChosenCommand& chosen);
void add_sweep_command(CLI::App& program, ChosenCommand& chosen);
void add_simulate_command(CLI::App& program, ChosenCommand& chosen);
void add_export_command(CLI::App& program, ChosenCommand& chosen);
void add_render_command(CLI::App& program, ChosenCommand& chosen);
void add_watch_command(CLI::App& program, ChosenCommand& chosen);

}  // namespace skysweep::app
