// SPDX-License-Identifier: Apache-2.0
// From a folder of photographs and a pose file to image records: what can be used, and for everything else the reason
// why not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/executor.h"
#include "core/vec.h"
#include "index/image_record.h"
#include "pipeline/configuration.h"

namespace skysweep::pipeline {

struct PhotographSet {
  std::vector<index::ImageRecord> records;  // sorted by name; footprints not yet known
  std::vector<std::string> notes;           // what the readers ignored or assumed
  std::vector<std::string> warnings;        // poses without photographs
};

// Lists the folder with its subfolders, pairs photographs with poses, checks each file's header and size against its
// camera and takes its digest. Bad photographs cost themselves only; throws Error(bad_input) when nothing can be used.
PhotographSet collect_photographs(const std::filesystem::path& images, const std::filesystem::path& poses, Vec3d origin,
                                  const PhotographOptions& options, Executor& executor);

// "3 of 18 photographs were refused", with the first few reasons; empty if none was.
std::vector<std::string> refusals(const std::vector<index::ImageRecord>& records);

}  // namespace skysweep::pipeline
