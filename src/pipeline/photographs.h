// SPDX-License-Identifier: Apache-2.0
// From a folder of photographs and a pose file to image records: what can be used, and for everything else the reason
// why not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/executor.h"
#include "core/vec.h"
#include "formats/pose_set.h"
#include "index/image_record.h"
#include "pipeline/configuration.h"

namespace skysweep::pipeline {

struct PhotographSet {
  std::vector<index::ImageRecord> records;  // sorted by name; footprints not yet known
  std::vector<std::string> notes;           // what the readers ignored or assumed
  std::vector<std::string> warnings;        // poses without photographs
};

// Lists the folder with its subfolders, pairs photographs with poses, checks each file's header and size against its
// camera and takes its digest. A file whose size and times are those of a record in `known` is not read again. Bad
// photographs cost themselves only; throws Error(bad_input) when nothing can be used, and Error(failed) when files
// vanish meanwhile: a disk that went away is no reason to map without it.
PhotographSet collect_photographs(const std::filesystem::path& images, const std::filesystem::path& poses, Vec3d origin,
                                  const PhotographOptions& options, Executor& executor,
                                  const std::vector<index::ImageRecord>& known = {});

// The same for photographs that somebody else has listed (`names`, relative to `images`) and poses already read.
PhotographSet inspect_photographs(const std::filesystem::path& images, const std::vector<std::string>& names,
                                  formats::PoseSet poses, Vec3d origin, const PhotographOptions& options,
                                  Executor& executor, const std::vector<index::ImageRecord>& known = {});

// "... is gone": says what to do about a photograph that was there a moment ago.
Error photograph_vanished(const std::filesystem::path& path);

// "3 of 18 photographs were refused", with the first few reasons; empty if none was.
std::vector<std::string> refusals(const std::vector<index::ImageRecord>& records);

}  // namespace skysweep::pipeline
