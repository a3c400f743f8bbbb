// SPDX-License-Identifier: Apache-2.0
// What a run may write, and whether the disk has room for it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "pipeline/project.h"

namespace skysweep::pipeline {

// At most: nothing compresses, every tile is full, and the mosaics repeat level 0.
std::uint64_t disk_bytes(std::size_t tiles, const ProjectSettings& settings);

// Throws Error(failed) with both figures and what to do.
void require_disk_space(const std::filesystem::path& project, std::uint64_t bytes);

}  // namespace skysweep::pipeline
