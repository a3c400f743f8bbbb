// SPDX-License-Identifier: Apache-2.0
// Whether a project's lattice can be counted: tiles, cells and planes within the numbers that stand for them, and few
// enough that the run comes to an end.
#pragma once

#include <string>
#include <vector>

#include "index/image_record.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// Throws Error(usage), with a sentence that says which option to change, when tiles or planes would be too many or too
// far out to be numbered. Called before anything is made on disk.
void require_countable_lattice(const std::vector<index::ImageRecord>& records, const ProjectSettings& settings);

// What the numbers chosen cannot resolve: a sentence each, for the user. Empty for every usual flight.
std::vector<std::string> resolution_warnings(const std::vector<index::ImageRecord>& records,
                                             const ProjectSettings& settings);

// Photographs far from all others, a sentence each: positions without a fix, of another UTM zone or another site.
std::vector<std::string> scatter_warnings(const std::vector<index::ImageRecord>& records);

}  // namespace skysweep::pipeline
