// SPDX-License-Identifier: Apache-2.0
#include "pipeline/coverage.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "pipeline/tile_geometry.h"

namespace skysweep::pipeline {
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
    : records_(records), settings_(settings) {
  for (int i = 0; i < static_cast<int>(records.size()); ++i) {
    if (records[i].status != index::ImageStatus::used) continue;
    const Box3d box = pyramid_box(camera::Camera(records[i].model, records[i].pose), settings.search);
    index_.insert(i, box, true);
  }
}

std::vector<tiles::TileKey> Coverage::tiles(const std::optional<Box2d>& area) const {
  const Box2d mapped = index_.mapped_area();
  if (mapped.empty()) return {};
  const tiles::Lattice& lattice = settings_.lattice;
  const tiles::TileKey first = lattice.key_at(0, mapped.min);
  std::vector<tiles::TileKey> keys;
  for (const tiles::TileKey key : touched_tiles(mapped)) {
    if (area && !area->intersects(lattice.extent(key))) continue;
    if (static_cast<int>(candidates(key).size()) >= settings_.configuration.sweep.min_views) keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end(), [&](tiles::TileKey a, tiles::TileKey b) {
    const auto position = [&](tiles::TileKey k) {
      return morton(static_cast<std::uint32_t>(k.x - first.x), static_cast<std::uint32_t>(k.y - first.y));
    };
    return position(a) < position(b);
  });
  return keys;
}

// Photograph by photograph, not over the box around all of them: one position without a fix, at (0, 0), would make
// that as large as a continent.
std::set<tiles::TileKey> Coverage::touched_tiles(const Box2d& mapped) const {
  const double reach = settings_.configuration.tiles.collar_cells * settings_.lattice.cell_m + kSlackM;
  std::set<tiles::TileKey> keys;
  for (const index::ImageRecord& record : records_) {
    if (record.status != index::ImageStatus::used) continue;
    const Box2d box = pyramid_box(camera::Camera(record.model, record.pose), settings_.search).ground();
    const Vec2d low{std::max(box.min.x - reach, mapped.min.x), std::max(box.min.y - reach, mapped.min.y)};
    const Vec2d high{std::min(box.max.x + reach, mapped.max.x), std::min(box.max.y + reach, mapped.max.y)};
    const tiles::TileKey first = settings_.lattice.key_at(0, low), last = settings_.lattice.key_at(0, high);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) keys.insert({0, x, y});
  }
  return keys;
}

std::vector<const index::ImageRecord*> Coverage::candidates(tiles::TileKey key) const {
  const Box2d world = tile_with_collar(key, settings_);
  const Box3d extent = index_.extent();
  const Box3d query{{world.min.x - kSlackM, world.min.y - kSlackM, extent.min.z},
                    {world.max.x + kSlackM, world.max.y + kSlackM, extent.max.z}};
  const Vec2d corner = settings_.lattice.south_west_corner(key);
  const TileOptions& options = settings_.configuration.tiles;
  const double cell = settings_.lattice.cell_m, collar = options.collar_cells * cell;
  const Box2d own{{-collar, -collar}, {options.cells * cell + collar, options.cells * cell + collar}};
  std::vector<const index::ImageRecord*> found;
  for (const int id : index_.query(query)) {
    const index::ImageRecord& image = records_[id];
    const camera::Camera local = camera::Camera(image.model, image.pose).relative_to({corner.x, corner.y, 0});
    if (pyramid_box(local, settings_.search).ground().intersects(own)) found.push_back(&image);
  }
  return found;
}

std::vector<Vec2d> ground_footprint(const index::ImageRecord& image, const SearchRange& search) {
  const camera::Camera camera(image.model, image.pose);
  const double z = camera.pose().center.z - search.ground_depth_m;
  return camera::footprint(camera, z, z, kLongestRay * search.reach_depth_m);
}

}  // namespace skysweep::pipeline
