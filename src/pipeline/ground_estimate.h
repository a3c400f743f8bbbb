// SPDX-License-Identifier: Apache-2.0
// What a new project derives from its photographs: how far the ground is, and from that cell size, plane step and the
// range in which surfaces are looked for.
#pragma once

#include <optional>
#include <vector>

#include "core/executor.h"
#include "index/image_record.h"
#include "pipeline/photo_cache.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// Depths below the cameras, from probes of up to a dozen photographs spread over the block (sweep::probe_depth). With
// `heights` (--z-range) nothing is probed: the cameras' heights above it tell. Does not depend on where in the world
// the scene lies. Throws Error(bad_input) with a sentence when no overlap can be found.
SearchRange estimate_search_range(const std::vector<index::ImageRecord>& records,
                                  const std::optional<sweep::HeightRange>& heights, PhotoCache& photos,
                                  Executor& executor);

// Median ground sampling distance of the used photographs, rounded to two digits.
double default_cell(const std::vector<index::ImageRecord>& records, const SearchRange& search);

// Height step that moves a point by `plane_step_px` in the photographs with the longest baseline that typically serve a
// place: plane_step_px * GSD / (B / H), rounded to two digits.
double default_plane_step(const std::vector<index::ImageRecord>& records, const SearchRange& search,
                          double plane_step_px);

}  // namespace skysweep::pipeline
