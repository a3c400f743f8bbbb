// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: the first one asks the run to finish what it has begun, the second one ends the program at once
// (nothing half-written stays behind either way: writes are atomic).
#pragma once

#include <atomic>

namespace skysweep::app {

// Becomes true at the first signal. Installs the handlers when first called.
const std::atomic<bool>& interrupt_requested();

// Becomes true at SIGHUP; whoever sees it puts it back. Installs the handler when first called.
std::atomic<bool>& reload_requested();

constexpr int kExitInterrupted = 130;

}  // namespace skysweep::app
