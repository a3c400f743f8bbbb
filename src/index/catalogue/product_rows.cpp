// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue/product_rows.h"

namespace skysweep::index {

void put_product_rows(GDALDataset& dataset, const std::vector<ProductRecord>& products) {
  std::vector<std::string> names;
  for (const ProductRecord& product : products) names.push_back(product.name);
  put_rows(dataset, "products", names, [&](std::size_t i, OGRFeature& row) {
    row.SetField("digest", products[i].digest.c_str());
    row.SetField("stamp", products[i].stamp.c_str());
  });
}

std::vector<ProductRecord> product_rows(GDALDataset& dataset) {
  std::vector<ProductRecord> products;
  for (const OGRFeatureUniquePtr& row : *dataset.GetLayerByName("products"))
    products.push_back(
        {row->GetFieldAsString("name"), row->GetFieldAsString("digest"), row->GetFieldAsString("stamp")});
  return products;
}

}  // namespace skysweep::index
