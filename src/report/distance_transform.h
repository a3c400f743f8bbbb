// SPDX-License-Identifier: Apache-2.0
// How far every cell lies from the nearest marked one.
#pragma once

#include <cstdint>

#include "core/array2d.h"

namespace skysweep::report {

// Squared Euclidean distance, in cells, from each cell's centre to that of the nearest cell that is not 0; infinity
// where none is marked. Exact (up to distances of 4096 cells, where squares leave the integers of a float). Two passes
// in linear time: Felzenszwalb and Huttenlocher 2012, Theory of Computing 8.
Array2d<float> squared_distance_to(const Array2d<std::uint8_t>& marked);

}  // namespace skysweep::report
