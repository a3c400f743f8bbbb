// SPDX-License-Identifier: Apache-2.0
#include "pipeline/coverage.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string_view>

#include "core/check.h"
#include "pipeline/tile_digest.h"
#include "pipeline/tile_geometry.h"
#include "raster/digest.h"

namespace skysweep::pipeline {

using tiles::TileKey;

namespace {

constexpr double kSlackM = 1e-3;  // the index answers in world coordinates; the exact test has the last word

// Rays flatter than this many times the depth are cut off.
constexpr double kLongestRay = 4;

// How far below a camera its photograph counts.
double reach_height(const camera::Camera& camera, const SearchRange& search) {
  if (search.heights) return search.heights->z_low;
  return camera.pose().center.z - search.reach_depth_m;
}

Box3d pyramid_box(const camera::Camera& camera, const SearchRange& search) {
  return camera::view_pyramid_box(camera, reach_height(camera, search), kLongestRay * search.reach_depth_m);
}

// Position along the Z-order curve of two non-negative numbers.
std::uint64_t morton(std::uint32_t x, std::uint32_t y) {
  const auto spread = [](std::uint64_t v) {
    v = (v | (v << 16)) & 0x0000FFFF0000FFFFull;
    v = (v | (v << 8)) & 0x00FF00FF00FF00FFull;
    v = (v | (v << 4)) & 0x0F0F0F0F0F0F0F0Full;
    v = (v | (v << 2)) & 0x3333333333333333ull;
    return (v | (v << 1)) & 0x5555555555555555ull;
  };
  return spread(x) | (spread(y) << 1);
}

}  // namespace

Coverage::Coverage(const std::vector<index::ImageRecord>& records, const ProjectSettings& settings)
    : settings_(settings) {
  for (const index::ImageRecord& record : records) add(record);
}

void Coverage::add(const index::ImageRecord& record) {
  if (record.status != index::ImageStatus::used) return;
  const int id = static_cast<int>(by_id_.size());
  const bool is_new = ids_.emplace(record.name, id).second;
  SKY_CHECK(is_new);
  const Box3d box = pyramid_box(camera::Camera(record.model, record.pose), settings_.search);
  by_id_.push_back({&record, box.ground(), {}});
  const std::string digest = photograph_digest(record);
  SKY_CHECK_EQ(digest.size(), by_id_.back().digest.size());
  std::copy(digest.begin(), digest.end(), by_id_.back().digest.begin());
  index_.insert(id, box, false);  // all of them count, so that the index need not keep those that do apart
}

void Coverage::remove(const std::string& name) {
  const auto found = ids_.find(name);
  if (found == ids_.end()) return;
  index_.remove(found->second);
  by_id_[static_cast<std::size_t>(found->second)].record = nullptr;
  ids_.erase(found);
}

// Photograph by photograph, not over the box around all of them: one position without a fix, at (0, 0), would make
// that as large as a continent.
std::vector<TileKey> Coverage::touched(const index::ImageRecord& record) const {
  const double reach = settings_.configuration.tiles.collar_cells * settings_.lattice.cell_m + kSlackM;
  const Box2d mapped = index_.extent().ground();
  const Box2d box = pyramid_box(camera::Camera(record.model, record.pose), settings_.search).ground();
  const Vec2d low{std::max(box.min.x - reach, mapped.min.x), std::max(box.min.y - reach, mapped.min.y)};
  const Vec2d high{std::min(box.max.x + reach, mapped.max.x), std::min(box.max.y + reach, mapped.max.y)};
  if (low.x > high.x || low.y > high.y) return {};
  const TileKey first = settings_.lattice.key_at(0, low), last = settings_.lattice.key_at(0, high);
  std::vector<TileKey> keys;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) keys.push_back({0, x, y});
  return keys;
}

std::vector<TileKey> Coverage::tiles(const std::optional<Box2d>& area) const {
  std::set<TileKey> touched_ones;
  for (const Entry& entry : by_id_)
    if (entry.record)
      for (const TileKey key : touched(*entry.record)) touched_ones.insert(key);
  std::vector<TileKey> keys;
  for (const TileKey key : touched_ones) {
    if (area && !area->intersects(settings_.lattice.extent(key))) continue;
    if (is_mapped(key)) keys.push_back(key);
  }
  sort_along_curve(keys);
  return keys;
}

bool Coverage::is_mapped(TileKey key) const {
  return static_cast<int>(candidate_ids(key).size()) >= settings_.configuration.sweep.min_views;
}

std::vector<int> Coverage::candidate_ids(TileKey key) const {
  const Box2d world = tile_with_collar(key, settings_);
  const Box3d extent = index_.extent();
  const Box3d query{{world.min.x - kSlackM, world.min.y - kSlackM, extent.min.z},
                    {world.max.x + kSlackM, world.max.y + kSlackM, extent.max.z}};
  std::vector<int> ids = index_.query(query);
  std::erase_if(ids, [&](int id) { return !may_show(by_id_[static_cast<std::size_t>(id)], key, world); });
  return ids;
}

std::vector<const index::ImageRecord*> Coverage::candidates(TileKey key) const {
  std::vector<const index::ImageRecord*> found;
  for (const int id : candidate_ids(key)) found.push_back(by_id_[static_cast<std::size_t>(id)].record);
  std::sort(found.begin(), found.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
  return found;
}

// In the order of the digests themselves: as good as any that does not depend on the order of arrival.
std::string Coverage::candidates_digest(TileKey key, const std::string& settings) const {
  std::vector<std::string_view> photographs;
  for (const int id : candidate_ids(key)) {
    const Entry& entry = by_id_[static_cast<std::size_t>(id)];
    photographs.emplace_back(entry.digest.data(), entry.digest.size());
  }
  std::sort(photographs.begin(), photographs.end());
  raster::Digest digest;
  digest.add_field(key.name());
  digest.add_field(settings);
  for (const std::string_view photograph : photographs) digest.add_bytes(photograph);
  return digest.hex();
}

// World coordinates decide where rounding cannot: well inside. Near the border the tile's own frame has the last word.
bool Coverage::may_show(const Entry& entry, TileKey key, const Box2d& tile) const {
  const Box2d well_inside{{tile.min.x + kSlackM, tile.min.y + kSlackM}, {tile.max.x - kSlackM, tile.max.y - kSlackM}};
  if (entry.ground.intersects(well_inside)) return true;
  const Vec2d corner = settings_.lattice.south_west_corner(key);
  const TileOptions& options = settings_.configuration.tiles;
  const double cell = settings_.lattice.cell_m, collar = options.collar_cells * cell;
  const Box2d own{{-collar, -collar}, {options.cells * cell + collar, options.cells * cell + collar}};
  const camera::Camera local =
      camera::Camera(entry.record->model, entry.record->pose).relative_to({corner.x, corner.y, 0});
  return pyramid_box(local, settings_.search).ground().intersects(own);
}

void sort_along_curve(std::vector<TileKey>& keys) {
  constexpr int kFirst = -(1 << 28);  // no index is lower
  std::sort(keys.begin(), keys.end(), [](TileKey a, TileKey b) {
    const auto position = [](TileKey k) {
      return morton(static_cast<std::uint32_t>(k.x - kFirst), static_cast<std::uint32_t>(k.y - kFirst));
    };
    return position(a) < position(b);
  });
}

std::vector<Vec2d> ground_footprint(const index::ImageRecord& image, const SearchRange& search) {
  const camera::Camera camera(image.model, image.pose);
  const double z = camera.pose().center.z - search.ground_depth_m;
  return camera::footprint(camera, z, z, kLongestRay * search.reach_depth_m);
}

}  // namespace skysweep::pipeline
