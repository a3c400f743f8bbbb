// SPDX-License-Identifier: Apache-2.0
// What stands beside the photographs of a scene for other programs: a COLMAP model with tracks, ground control points.
#pragma once

#include <filesystem>
#include <vector>

#include "camera/camera.h"
#include "formats/pose_set.h"
#include "scene/scene.h"

namespace skysweep::scene {

class World;

// Throws Error(usage) if a product that the scene asks for cannot be had in its reference system or format.
void require_products_possible(const Scene& scene);

// sparse/ and, if asked for, gcp_list.txt. `photographs` and `cameras` (the latter in the scene's frame) in one order.
// Observations are where `cameras` see the points, whatever the poses of `photographs` say.
void write_products(const Scene& scene, const World& world, const std::vector<formats::PosedImage>& photographs,
                    const std::vector<camera::Camera>& cameras, const std::filesystem::path& folder);

}  // namespace skysweep::scene
