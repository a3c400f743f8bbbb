// SPDX-License-Identifier: Apache-2.0
#include "tiles/pyramid.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "raster/digest.h"

namespace skysweep::tiles {

namespace {

constexpr int kHighestPossibleLevel = 30;  // indices have 29 bits
using Children = std::array<TileKey, 4>;   // south-west, south-east, north-west, north-east

Children children_from(TileKey south_west) {
  const auto at = [&](int dx, int dy) { return TileKey{south_west.level, south_west.x + dx, south_west.y + dy}; };
  return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
}

Children children_of(TileKey key, const LevelPlan& plan) {
  return children_from(key.is_top() ? plan.top_south_west : key.child(0, 0));
}

LevelPlan plan_for(const std::vector<TileKey>& tiles) {
  const auto [west, east] =
      std::minmax_element(tiles.begin(), tiles.end(), [](TileKey a, TileKey b) { return a.x < b.x; });
  const auto [south, north] =
      std::minmax_element(tiles.begin(), tiles.end(), [](TileKey a, TileKey b) { return a.y < b.y; });
  return plan_levels(west->x, south->y, east->x, north->y);
}

std::set<TileKey> parents_of(const std::vector<TileKey>& tiles) {
  std::set<TileKey> parents;
  for (const TileKey key : tiles) parents.insert(key.parent());
  return parents;
}

// What a parent is computed from: where it lies and what its children were computed from. Nothing without children.
std::optional<std::string> digest_from_children(const TileStore& store, const Children& children) {
  bool any = false;
  raster::Digest digest;
  digest.add_field(children[0].name());
  for (const TileKey child : children) {
    const std::optional<std::string> of_child = store.input_digest(child);
    any |= of_child.has_value();
    digest.add_field(of_child.value_or(""));
  }
  if (!any) return std::nullopt;
  return digest.hex();
}

// Writes the parent, or removes it if it has no children. Whether it was written.
bool rebuild(const TileStore& store, TileKey key, const LevelPlan& plan) {
  const Children keys = children_of(key, plan);
  const std::optional<std::string> digest = digest_from_children(store, keys);
  if (!digest) {
    store.remove(key);
    return false;
  }
  std::array<std::optional<Tile>, 4> tiles;
  std::array<const Tile*, 4> children{};
  for (int i = 0; i < 4; ++i) {
    tiles[i] = store.read(keys[i]);
    if (tiles[i]) children[i] = &*tiles[i];
  }
  store.write(key, merge_children(children, store.lattice().tile_cells), *digest, &plan);
  return true;
}

std::vector<TileKey> rebuild_level(const TileStore& store, const std::set<TileKey>& wanted, const LevelPlan& plan,
                                   Executor& executor) {
  const std::vector<TileKey> keys(wanted.begin(), wanted.end());
  std::vector<char> is_written(keys.size());  // not bool: threads write neighbours
  executor.parallel_for(static_cast<int>(keys.size()), [&](int i) { is_written[i] = rebuild(store, keys[i], plan); });
  std::vector<TileKey> written;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (is_written[i]) written.push_back(keys[i]);
  return written;
}

void remove_levels_above(const TileStore& store, int level) {
  for (int above = level + 1; above <= kHighestPossibleLevel; ++above)
    for (const TileKey key : store.list(above)) store.remove(key);
}

}  // namespace

std::vector<TileKey> rebuild_parents(const TileStore& store, const std::vector<TileKey>& changed, Executor& executor) {
  std::vector<TileKey> level = store.list(0);
  if (level.empty()) {
    remove_levels_above(store, 0);
    store.remove(TileKey::top());
    return {};
  }
  const LevelPlan plan = plan_for(level);
  std::vector<TileKey> all_written;
  std::set<TileKey> wanted = parents_of(changed);
  for (int l = 1; l <= plan.highest_regular_level; ++l) {
    const std::vector<TileKey> present = store.list(l);
    const std::set<TileKey> needed = parents_of(level);
    std::set_difference(needed.begin(), needed.end(), present.begin(), present.end(),
                        std::inserter(wanted, wanted.end()));
    const std::vector<TileKey> written = rebuild_level(store, wanted, plan, executor);
    all_written.insert(all_written.end(), written.begin(), written.end());
    // A parent that went away changes its own parent, too.
    wanted = parents_of({wanted.begin(), wanted.end()});
    level = store.list(l);
  }
  const std::vector<TileKey> top = rebuild_level(store, {TileKey::top()}, plan, executor);
  all_written.insert(all_written.end(), top.begin(), top.end());
  remove_levels_above(store, plan.highest_regular_level);
  return all_written;
}

std::vector<TileKey> rebuild_parents(const TileStore& store, const std::vector<TileKey>& changed) {
  SerialExecutor executor;
  return rebuild_parents(store, changed, executor);
}

std::vector<TileKey> find_outdated(const TileStore& store) {
  std::vector<TileKey> outdated;
  const std::vector<TileKey> finest = store.list(0);
  if (finest.empty()) return outdated;
  const LevelPlan plan = plan_for(finest);
  for (int level = 1; level <= plan.highest_regular_level; ++level)
    for (const TileKey key : store.list(level))
      if (store.input_digest(key) != digest_from_children(store, children_of(key, plan)))
        outdated.push_back({0, key.x << level, key.y << level});
  return outdated;
}

}  // namespace skysweep::tiles
