// SPDX-License-Identifier: Apache-2.0
// Whether a run makes a new project or goes on with an old one, and what a new one is made of.
#pragma once

#include <optional>
#include <vector>

#include "core/executor.h"
#include "index/image_record.h"
#include "pipeline/photo_cache.h"
#include "pipeline/project.h"
#include "pipeline/session.h"

namespace skysweep::pipeline {

struct ProjectChoice {
  Configuration configuration;
  std::optional<ProjectSettings> existing;  // the project on disk, when the run goes on with it
};

// Throws Error(usage) naming the difference when the request contradicts the project on disk.
ProjectChoice choose_project(const RunRequest& request, const ProjectPaths& paths);

// What the request leaves open is derived from the photographs.
ProjectSettings new_project_settings(const RunRequest& request, const Configuration& configuration,
                                     const std::vector<index::ImageRecord>& records, PhotoCache& photos,
                                     Executor& executor, Progress& progress);

// Writes project.toml; with `fresh` what an earlier project left in the folder goes first.
void make_project(const ProjectPaths& paths, const ProjectSettings& settings, bool fresh);

// Goes on with the instruction set or GPU the project was made with, so that its tiles stay comparable bit for bit.
// Throws Error(failed) if this machine lacks it.
void use_recorded_engine(const ProjectSettings& settings);

}  // namespace skysweep::pipeline
