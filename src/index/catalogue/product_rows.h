// SPDX-License-Identifier: Apache-2.0
// Product records as rows of the table `products`.
#pragma once

#include <vector>

#include "index/catalogue.h"
#include "index/catalogue/geopackage.h"

namespace skysweep::index {

void put_product_rows(GDALDataset& dataset, const std::vector<ProductRecord>& products);

// In no particular order.
std::vector<ProductRecord> product_rows(GDALDataset& dataset);

}  // namespace skysweep::index
