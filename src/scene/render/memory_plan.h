// SPDX-License-Identifier: Apache-2.0
// What a simulation will hold in memory beside its world.
#pragma once

#include <cstdint>

#include "scene/render/truth.h"

namespace skysweep::scene {

// Bytes, at their highest: two photographs (one rendered, one encoded) with their encoder's copies, or the truth; and
// what the libraries hold once they encode and write.
std::uint64_t planned_bytes(const Scene& scene, const TruthGrid& grid);

}  // namespace skysweep::scene
