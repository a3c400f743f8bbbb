// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue/tile_rows.h"

#include <cpl_json.h>

#include "index/catalogue/polygon.h"

namespace skysweep::index {
namespace {

std::string json_from(const std::vector<std::string>& names) {
  CPLJSONArray array;
  for (const std::string& name : names) array.Add(name);
  return array.Format(CPLJSONObject::PrettyFormat::Plain);
}

std::vector<std::string> names_in(const std::string& json) {
  CPLJSONDocument document;
  if (!document.LoadMemory(json)) return {};  // the failure is known to QuietGdal
  std::vector<std::string> names;
  for (const CPLJSONObject& name : document.GetRoot().ToArray()) names.push_back(name.ToString());
  return names;
}

void put_tile(OGRFeature& row, const TileRecord& tile) {
  const auto [low, high] = tile.extent;
  row.SetGeometryDirectly(polygon_from({low, {high.x, low.y}, high, {low.x, high.y}}).release());
  row.SetField("level", tile.level);
  row.SetField("digest", tile.input_digest.c_str());
  row.SetField("view_count", static_cast<int>(tile.views.size()));
  row.SetField("views", json_from(tile.views).c_str());
  row.SetField("valid_share", tile.valid_share);
  row.SetField("z_low", tile.z_low);
  row.SetField("z_high", tile.z_high);
  row.SetField("seconds", tile.seconds);
  row.SetField("candidates_digest", tile.candidates_digest.c_str());
  row.SetField("view_digests", json_from(tile.view_digests).c_str());
  row.SetField("checksum", tile.checksum.c_str());
  row.SetField("stamp", tile.stamp.c_str());
}

TileRecord tile_in(const OGRFeature& row) {
  TileRecord tile;
  tile.name = row.GetFieldAsString("name");
  tile.level = row.GetFieldAsInteger("level");
  for (const Vec2d corner : corners_of(row.GetGeometryRef())) tile.extent.extend(corner);
  tile.input_digest = row.GetFieldAsString("digest");
  tile.views = names_in(row.GetFieldAsString("views"));
  tile.valid_share = row.GetFieldAsDouble("valid_share");
  tile.z_low = row.GetFieldAsDouble("z_low");
  tile.z_high = row.GetFieldAsDouble("z_high");
  tile.seconds = row.GetFieldAsDouble("seconds");
  tile.candidates_digest = row.GetFieldAsString("candidates_digest");
  tile.view_digests = names_in(row.GetFieldAsString("view_digests"));
  tile.checksum = row.GetFieldAsString("checksum");
  tile.stamp = row.GetFieldAsString("stamp");
  return tile;
}

}  // namespace

void put_tile_rows(GDALDataset& dataset, const std::vector<TileRecord>& tiles) {
  std::vector<std::string> names;
  for (const TileRecord& tile : tiles) names.push_back(tile.name);
  put_rows(dataset, "tiles", names, [&](std::size_t i, OGRFeature& row) { put_tile(row, tiles[i]); });
}

std::vector<TileRecord> tile_rows(GDALDataset& dataset) {
  std::vector<TileRecord> tiles;
  for (const OGRFeatureUniquePtr& row : *dataset.GetLayerByName("tiles")) tiles.push_back(tile_in(*row));
  return tiles;
}

}  // namespace skysweep::index
