// SPDX-License-Identifier: Apache-2.0
// The tags that a scene's photographs carry.
#pragma once

#include <string>
#include <vector>

#include "formats/photo_metadata.h"
#include "formats/pose_set.h"
#include "scene/scene.h"

namespace skysweep::scene {

// Throws Error(usage) if the scene's photographs cannot carry tags.
void require_metadata_possible(const Scene& scene);

// For each photograph, from the poses that are recorded of it (world coordinates); empty if the scene asks for none.
// `crs`: WKT; of a local frame no position is known. Times: the aircraft flies from pose to pose at constant speed.
std::vector<formats::PhotoMetadata> metadata_of(const Scene& scene, const std::vector<formats::PosedImage>& photographs,
                                                const std::string& crs, const std::string& software);

}  // namespace skysweep::scene
