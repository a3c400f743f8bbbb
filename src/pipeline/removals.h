// SPDX-License-Identifier: Apache-2.0
// Photographs that the user has taken out of a project (`run --remove`) although their files are there: removed.toml.
// They stay out, however often the project is run, until they are taken back (`run --restore`).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "index/image_record.h"
#include "pipeline/project.h"

namespace skysweep::pipeline {

// Names of the photographs removed; none if the file is missing. Throws Error(bad_input) if it is damaged.
std::set<std::string> read_removals(const ProjectPaths& paths);
void write_removals(const ProjectPaths& paths, const std::set<std::string>& names);

// The removals after these requests: names that match a pattern of `remove` join, those that match one of `restore`
// leave. Patterns are the shell's (* ? [a-z]) over the whole name; * also stands for folders. Throws Error(usage) when
// a pattern matches none of the photographs, or of the removed ones.
std::set<std::string> changed_removals(std::set<std::string> removed,
                                       const std::vector<index::ImageRecord>& photographs,
                                       const std::vector<std::string>& remove, const std::vector<std::string>& restore);

// Marks the removed ones among the records. Throws Error(usage) when fewer than two are left in use.
void mark_removed(std::vector<index::ImageRecord>& records, const std::set<std::string>& removed);

}  // namespace skysweep::pipeline
