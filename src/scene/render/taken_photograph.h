// SPDX-License-Identifier: Apache-2.0
// A photograph between the camera and the disk, with what else is recorded through the same pixels.
#pragma once

#include <filesystem>
#include <string>

#include "formats/photo_metadata.h"
#include "scene/render/photograph.h"

namespace skysweep::scene {

struct TakenPhotograph {
  Array2d<Rgb8> levels;      // of all formats but EXR
  Array2d<LinearRgb> light;  // of EXR
  Array2d<float> depth;      // empty unless the scene asks for it
};

TakenPhotograph take(const Scene& scene, const World& world, const PixelRays& rays, const camera::Pose& pose,
                     const Exposure& exposure, const PhotographEffects* effects, Executor& executor);

// images/NAME, with the tags unless `metadata` is null, and truth/depth/NAME.exr; each file atomically. Throws
// Error(failed).
void write_taken(const Scene& scene, const TakenPhotograph& photograph, const std::string& name,
                 const formats::PhotoMetadata* metadata, const std::string& software,
                 const std::filesystem::path& folder);

}  // namespace skysweep::scene
