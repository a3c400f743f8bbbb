// SPDX-License-Identifier: Apache-2.0
// Tile records as rows of the layer `tiles`.
#pragma once

#include <vector>

#include "index/catalogue.h"
#include "index/catalogue/geopackage.h"

namespace skysweep::index {

void put_tile_rows(GDALDataset& dataset, const std::vector<TileRecord>& tiles);

// In no particular order.
std::vector<TileRecord> tile_rows(GDALDataset& dataset);

}  // namespace skysweep::index
