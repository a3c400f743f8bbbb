// SPDX-License-Identifier: Apache-2.0
// How a run divides the memory it may use: computed before it starts, so that a job that cannot fit says so then.
#pragma once

#include <cstddef>
#include <vector>

#include "index/image_record.h"
#include "pipeline/configuration.h"

namespace skysweep::pipeline {

struct MemoryPlan {
  std::size_t limit_bytes = 0;        // --memory
  std::size_t program_bytes = 0;      // libraries, catalogue, index
  std::size_t photo_cache_bytes = 0;  // decoded photographs
  std::size_t tile_bytes = 0;         // working set of one tile without its photographs
  int tiles_in_flight = 0;
};

// Half of the machine's memory.
std::size_t default_memory_limit();

// Throws Error(memory_plan), naming the smallest limit that would do, if not even one tile with its photographs fits.
MemoryPlan plan_memory(std::size_t limit_bytes, const std::vector<index::ImageRecord>& records,
                       const Configuration& configuration, int threads);

}  // namespace skysweep::pipeline
