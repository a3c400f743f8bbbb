// SPDX-License-Identifier: Apache-2.0
// Ground from a raster of heights.
#pragma once

#include "scene/scene.h"
#include "scene/world/terrain/height_grid.h"

namespace skysweep::scene {

// The heights of the file in the frame of `scene`. Throws Error naming the file: missing, damaged, rotated, with holes,
// smaller than 2 x 2; and Error(usage) if it does not cover the mapped area or is in another CRS than the scene.
HeightGrid read_dem(const DemTerrain& shape, const Scene& scene);

}  // namespace skysweep::scene
