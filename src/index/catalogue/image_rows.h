// SPDX-License-Identifier: Apache-2.0
// Image records as rows of the layers `images` and `cameras`.
#pragma once

#include <vector>

#include "index/catalogue/geopackage.h"
#include "index/image_record.h"

namespace skysweep::index {

void put_image_rows(GDALDataset& dataset, const std::vector<ImageRecord>& images);

// Cameras that no image refers to any more.
void remove_unused_cameras(GDALDataset& dataset);

// In no particular order. Throws Error(bad_input) with the rest of a sentence for values that no program of ours
// writes.
std::vector<ImageRecord> image_rows(GDALDataset& dataset);

}  // namespace skysweep::index
