// SPDX-License-Identifier: Apache-2.0
#include "tiles/pyramid.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "raster/digest.h"

namespace skysweep::tiles {

namespace {

constexpr int kHighestPossibleLevel = 30;  // indices have 29 bits
using Children = std::array<TileKey, 4>;   // south-west, south-east, north-west, north-east
using Digests = std::map<TileKey, std::string>;

Children children_of(TileKey key, const LevelPlan& plan) {
  const TileKey south_west = key.is_top() ? plan.top_south_west : key.child(0, 0);
  const auto at = [&](int dx, int dy) { return TileKey{south_west.level, south_west.x + dx, south_west.y + dy}; };
  return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
}

ParentState state_of(const Children& keys, const Digests& level) {
  ParentState state;
  raster::Digest digest;
  digest.add_field(keys[0].name());
  for (int i = 0; i < 4; ++i) {
    const auto found = level.find(keys[i]);
    if (found != level.end()) state.children[i] = {keys[i].name(), found->second};
    digest.add_field(state.children[i].digest);
  }
  state.digest = digest.hex();
  return state;
}

// One parent from what is on disk. Nothing if a tile that it needs cannot be read; that one is named.
class ParentMaker {
 public:
  ParentMaker(const TileStore& store, const LevelPlan& plan) : store_(store), plan_(plan) {}

  // `old`: what the parent on disk was made from; null: none is there. Returns the number of quadrants made.
  std::optional<int> make(TileKey key, const ParentState& wanted, const ParentState* old, TileKey& unreadable) const {
    std::optional<Tile> parent = old ? reusable(key, wanted, *old) : std::nullopt;
    const bool reuse = parent.has_value();
    if (!reuse) parent = empty_parent(store_.lattice().tile_cells);
    const Children keys = children_of(key, plan_);
    int made = 0;
    for (int i = 0; i < 4; ++i) {
      if (reuse && old->children[i] == wanted.children[i]) continue;
      std::optional<Tile> child;
      if (!wanted.children[i].name.empty()) {
        child = read(keys[i]);
        if (!child) {
          unreadable = keys[i];
          return std::nullopt;
        }
      }
      if (!reuse && !child) continue;
      put_quadrant(*parent, i, child ? &*child : nullptr);
      ++made;
    }
    parent->searched.reset();
    store_.write(key, *parent, wanted.digest, &plan_);
    return made;
  }

 private:
  std::optional<Tile> read(TileKey key) const {
    try {
      return store_.read(key);
    } catch (const Error&) {
      return std::nullopt;
    }
  }

  // The parent on disk, if any quadrant of it can stay.
  std::optional<Tile> reusable(TileKey key, const ParentState& wanted, const ParentState& old) const {
    for (int i = 0; i < 4; ++i)
      if (!old.children[i].name.empty() && old.children[i] == wanted.children[i]) return read(key);
    return std::nullopt;
  }

  const TileStore& store_;
  const LevelPlan& plan_;
};

// The parents of one level, brought up to date.
class LevelUpdate {
 public:
  LevelUpdate(const TileStore& store, const LevelPlan& plan, const PyramidState& state, PyramidChanges& changes)
      : store_(store), plan_(plan), state_(state), changes_(changes) {}

  // Digests of the level's tiles.
  Digests run(const std::set<TileKey>& keys, const Digests& below, Executor& executor,
              const PyramidListener& listener) {
    Digests level;
    std::vector<TileKey> stale;
    std::vector<ParentState> wanted;
    for (const TileKey key : keys) {
      ParentState state = state_of(children_of(key, plan_), below);
      level[key] = state.digest;
      if (const ParentState* old = recorded(key); old && old->digest == state.digest) continue;
      stale.push_back(key);
      wanted.push_back(std::move(state));
    }
    make(stale, wanted, executor, listener);
    return level;
  }

 private:
  const ParentState* recorded(TileKey key) const {
    const auto found = state_.parents.find(key);
    return found == state_.parents.end() ? nullptr : &found->second;
  }

  void make(const std::vector<TileKey>& stale, const std::vector<ParentState>& wanted, Executor& executor,
            const PyramidListener& listener) {
    const ParentMaker maker(store_, plan_);
    std::vector<std::optional<int>> quadrants(stale.size());
    std::vector<TileKey> unreadable(stale.size());
    executor.parallel_for(static_cast<int>(stale.size()), [&](int i) {
      quadrants[i] = maker.make(stale[i], wanted[i], recorded(stale[i]), unreadable[i]);
    });
    std::map<TileKey, ParentState> written;
    for (std::size_t i = 0; i < stale.size(); ++i) {
      if (!quadrants[i]) {
        changes_.unreadable.push_back(unreadable[i]);
        continue;
      }
      changes_.written.push_back(stale[i]);
      changes_.quadrants_made += *quadrants[i];
      written[stale[i]] = wanted[i];
    }
    if (!written.empty()) listener(written);
  }

  const TileStore& store_;
  const LevelPlan& plan_;
  const PyramidState& state_;
  PyramidChanges& changes_;
};

std::set<TileKey> parents_of(const Digests& level) {
  std::set<TileKey> parents;
  for (const auto& [key, digest] : level) parents.insert(key.parent());
  return parents;
}

// Parents on disk, or on record, that the map does not have.
void remove_all_but(const std::set<TileKey>& wanted, const TileStore& store, const PyramidState& state,
                    PyramidChanges& changes) {
  std::set<TileKey> present;
  for (const auto& [key, parent] : state.parents) present.insert(key);
  for (int level = 1; level <= kHighestPossibleLevel; ++level)
    for (const TileKey key : store.list_remains(level)) present.insert(key);
  for (const TileKey key : present) {
    if (wanted.contains(key)) continue;
    store.remove(key);
    changes.removed.push_back(key);
  }
}

}  // namespace

LevelPlan plan_for(const Digests& finest) {
  SKY_CHECK(!finest.empty());
  const TileKey first = finest.begin()->first;
  int west = first.x, east = first.x, south = first.y, north = first.y;
  for (const auto& [key, digest] : finest) {
    west = std::min(west, key.x), east = std::max(east, key.x);
    south = std::min(south, key.y), north = std::max(north, key.y);
  }
  return plan_levels(west, south, east, north);
}

PyramidChanges update_parents(const TileStore& store, const PyramidState& state, Executor& executor,
                              const PyramidListener& listener) {
  PyramidChanges changes;
  if (state.finest.empty()) {
    remove_all_but({}, store, state, changes);
    store.remove(TileKey::top());
    return changes;
  }
  const LevelPlan plan = plan_for(state.finest);
  LevelUpdate update(store, plan, state, changes);
  Digests below = state.finest;
  std::set<TileKey> wanted{TileKey::top()};
  for (int level = 1; level <= plan.highest_regular_level && changes.unreadable.empty(); ++level) {
    const std::set<TileKey> keys = parents_of(below);
    wanted.insert(keys.begin(), keys.end());
    below = update.run(keys, below, executor, listener);
  }
  if (!changes.unreadable.empty()) return changes;
  update.run({TileKey::top()}, below, executor, listener);
  remove_all_but(wanted, store, state, changes);
  return changes;
}

PyramidState read_pyramid_state(const TileStore& store) {
  PyramidState state;
  for (const TileKey key : store.list(0))
    if (auto digest = store.input_digest(key)) state.finest[key] = std::move(*digest);
  const auto add_parent = [&](TileKey key) {
    if (auto digest = store.input_digest(key)) state.parents[key] = {std::move(*digest), {}};
  };
  for (int level = 1; level <= kHighestPossibleLevel; ++level)
    for (const TileKey key : store.list(level)) add_parent(key);
  add_parent(TileKey::top());
  return state;
}

PyramidChanges update_parents(const TileStore& store) {
  SerialExecutor executor;
  return update_parents(store, read_pyramid_state(store), executor, [](const auto&) {});
}

}  // namespace skysweep::tiles
