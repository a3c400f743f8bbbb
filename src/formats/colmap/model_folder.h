// SPDX-License-Identifier: Apache-2.0
// Poses from a COLMAP model: the folder with cameras and images, text or binary.
#pragma once

#include <optional>
#include <string>

#include "formats/colmap/records.h"
#include "formats/pose_set.h"

namespace skysweep::formats::colmap {

// How the model in this folder is encoded: binary if both are there, as COLMAP itself prefers. Nothing if the folder
// holds no model.
std::optional<Encoding> model_encoding(const std::string& folder);

// Throws Error(bad_input) if the folder holds no model or its files are broken.
PoseSet read_model(const std::string& folder);

}  // namespace skysweep::formats::colmap
