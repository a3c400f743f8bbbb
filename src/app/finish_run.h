// SPDX-License-Identifier: Apache-2.0
// What a run leaves for people and for GIS once the tiles are done: mosaics, preview, report.json, a few lines of text.
#pragma once

#include <chrono>

#include "app/console.h"
#include "pipeline/session.h"

namespace skysweep::app {

void finish_run(const pipeline::RunRequest& request, const pipeline::RunSummary& summary,
                std::chrono::steady_clock::time_point start, Console& console);

}  // namespace skysweep::app
