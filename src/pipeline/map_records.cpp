// SPDX-License-Identifier: Apache-2.0
#include "pipeline/map_records.h"

#include <utility>

#include "raster/digest.h"

namespace skysweep::pipeline {

using index::TileRecord;
using tiles::TileKey;

MapRecords::MapRecords(index::Catalogue& catalogue) : catalogue_(catalogue) {
  for (TileRecord& row : catalogue.tiles())
    if (const auto key = TileKey::parse(row.name)) rows_[*key] = std::move(row);
}

const TileRecord* MapRecords::find(TileKey key) const {
  const auto found = rows_.find(key);
  return found == rows_.end() ? nullptr : &found->second;
}

void MapRecords::put(const std::vector<TileRecord>& rows) {
  if (rows.empty()) return;
  catalogue_.put_tiles(rows);
  for (const TileRecord& row : rows) rows_[TileKey::parse(row.name).value()] = row;
}

void MapRecords::remove(const std::vector<TileKey>& keys) {
  std::vector<std::string> names;
  for (const TileKey key : keys)
    if (rows_.erase(key) > 0) names.push_back(key.name());
  if (!names.empty()) catalogue_.remove_tiles(names);
}

std::map<TileKey, std::string> MapRecords::finest() const {
  std::map<TileKey, std::string> digests;
  for (const auto& [key, row] : rows_)
    if (key.level == 0 && !row.checksum.empty()) digests[key] = row.input_digest;
  return digests;
}

std::string MapRecords::digest() const {
  raster::Digest digest;
  for (const auto& [key, of_tile] : finest()) digest.add_field(key.name()).add_field(of_tile);
  return digest.hex();
}

TileRecord row_of_parent(TileKey key, int level, const Box2d& extent, const tiles::ParentState& state) {
  TileRecord row;
  row.name = key.name();
  row.level = level;
  row.extent = extent;
  row.input_digest = state.digest;
  for (const tiles::ParentState::Child& child : state.children) {
    row.views.push_back(child.name);
    row.view_digests.push_back(child.digest);
  }
  return row;
}

tiles::ParentState parent_of_row(const TileRecord& row) {
  tiles::ParentState state{row.input_digest, {}};
  for (std::size_t i = 0; i < state.children.size() && i < row.views.size() && i < row.view_digests.size(); ++i)
    state.children[i] = {row.views[i], row.view_digests[i]};
  return state;
}

}  // namespace skysweep::pipeline
