// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live_mosaics.h"

#include <algorithm>
#include <set>

#include "tiles/virtual_mosaic.h"

namespace skysweep::pipeline {
namespace {

constexpr std::chrono::seconds kRest{2};

}  // namespace

void LiveMosaics::write(const MapRecords& records) { write_without(records, {}); }

void LiveMosaics::write_without(const MapRecords& records, const std::vector<tiles::TileKey>& leaving) {
  const std::set<tiles::TileKey> gone(leaving.begin(), leaving.end());
  std::vector<tiles::TileKey> finest, parents;
  for (const auto& [key, row] : records.rows()) {
    if (row.checksum.empty() || gone.contains(key) || key.is_top()) continue;
    (key.level == 0 ? finest : parents).push_back(key);
  }
  if (finest.empty()) {
    tiles::remove_virtual_mosaic(store_, "dem", paths_.vrt("dsm"));
    tiles::remove_virtual_mosaic(store_, "color", paths_.vrt("ortho"));
    return;
  }
  const std::string digest = records.digest();
  tiles::write_virtual_mosaic(store_, "dem", finest, parents, digest, paths_.vrt("dsm"));
  tiles::write_virtual_mosaic(store_, "color", finest, parents, digest, paths_.vrt("ortho"));
  last_ = std::chrono::steady_clock::now();
}

void LiveMosaics::write_now_and_then(const MapRecords& records) {
  if (std::chrono::steady_clock::now() - last_ >= kRest) write(records);
}

}  // namespace skysweep::pipeline
