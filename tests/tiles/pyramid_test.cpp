// SPDX-License-Identifier: Apache-2.0
#include "tiles/pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/executor.h"
#include "core/random.h"
#include "raster/crs.h"
#include "raster/temp_folder.h"
#include "tiles/random_tile.h"

namespace skysweep::tiles {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

constexpr int kCells = 8;

TileStore store_in(const fs::path& folder) {
  return {folder, Lattice{kCells, 0.1, 0.05}, raster::local_metric_crs(), "EGM96 height", "skysweep test"};
}

void write_finest(const TileStore& store, TileKey key, std::uint64_t seed = 0) {
  store.write(key, random_tile(key, kCells, seed), key.name() + "-" + std::to_string(seed));
}

// Every file below a folder with its bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(folder).string()] = file_bytes(entry.path());
  return files;
}

std::map<std::string, std::string> built_at_once(const fs::path& folder, const std::vector<TileKey>& keys) {
  const TileStore store = store_in(folder);
  for (const TileKey key : keys) write_finest(store, key);
  update_parents(store);
  return contents(folder);
}

// Scattered over all four quadrants, with gaps, five levels.
const std::vector<TileKey> kScattered = {{0, 0, 0},  {0, 1, 0},  {0, -1, 0}, {0, -1, -1}, {0, 5, 3},
                                         {0, -9, 2}, {0, 4, -7}, {0, 4, -6}, {0, 12, 0},  {0, 0, 11}};

TEST(Pyramid, growing_in_any_direction_and_order_gives_the_same_bytes) {
  const TempFolder folder;
  const auto expected = built_at_once(folder / "at-once", kScattered);
  Random random(17);
  for (int round = 0; round < 4; ++round) {
    std::vector<TileKey> order = kScattered;
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(static_cast<int>(i))]);
    const fs::path grown = folder / ("grown-" + std::to_string(round));
    const TileStore store = store_in(grown);
    for (std::size_t i = 0; i < order.size();) {
      std::vector<TileKey> step;
      for (int n = 1 + random.below(3); n > 0 && i < order.size(); --n) step.push_back(order[i++]);
      for (const TileKey key : step) write_finest(store, key);
      update_parents(store);
    }
    EXPECT_EQ(contents(grown), expected);
  }
}

TEST(Pyramid, tile_written_again_changes_its_parents_as_if_it_had_always_been_so) {
  const TempFolder folder;
  const auto expected = built_at_once(folder / "at-once", kScattered);
  const TileStore store = store_in(folder / "changed");
  for (const TileKey key : kScattered) write_finest(store, key, 99);
  update_parents(store);
  EXPECT_NE(contents(folder / "changed"), expected);
  for (const TileKey key : kScattered) {
    write_finest(store, key);
    update_parents(store);
  }
  EXPECT_EQ(contents(folder / "changed"), expected);
}

TEST(Pyramid, removed_tiles_leave_no_trace) {
  const TempFolder folder;
  std::vector<TileKey> more = kScattered;
  const std::vector<TileKey> passing = {{0, 40, 2}, {0, -30, -30}, {0, 2, 2}};
  more.insert(more.end(), passing.begin(), passing.end());
  built_at_once(folder / "shrunk", more);
  const TileStore store = store_in(folder / "shrunk");
  for (const TileKey key : passing) store.remove(key);
  update_parents(store);
  EXPECT_EQ(contents(folder / "shrunk"), built_at_once(folder / "at-once", kScattered));
  for (const TileKey key : kScattered) store.remove(key);
  EXPECT_TRUE(update_parents(store).written.empty());
  EXPECT_TRUE(contents(folder / "shrunk").empty());
}

TEST(Pyramid, threads_make_the_same_bytes) {
  const TempFolder folder;
  const TileStore store = store_in(folder / "threads");
  for (const TileKey key : kScattered) write_finest(store, key);
  ThreadExecutor executor(4);
  update_parents(store, read_pyramid_state(store), executor, [](const auto&) {});
  EXPECT_EQ(contents(folder / "threads"), built_at_once(folder / "at-once", kScattered));
}

TEST(Pyramid, only_the_parents_of_changed_tiles_are_written) {
  const TempFolder folder;
  built_at_once(folder.path(), kScattered);
  const TileStore store = store_in(folder.path());
  std::vector<TileKey> expected;
  for (TileKey key = TileKey{0, -9, 2}.parent(); key.level <= 4; key = key.parent()) expected.push_back(key);
  expected.push_back(TileKey::top());
  EXPECT_TRUE(update_parents(store).written.empty());
  write_finest(store, {0, -9, 2}, 99);
  EXPECT_EQ(update_parents(store).written, expected);
}

// Keeps the record that a pipeline keeps in its catalogue.
class RecordedPyramid {
 public:
  explicit RecordedPyramid(const fs::path& folder) : store(store_in(folder)) {}

  void write(TileKey key, std::uint64_t seed = 0) {
    write_finest(store, key, seed);
    state.finest[key] = store.input_digest(key).value();
  }

  PyramidChanges update() {
    SerialExecutor executor;
    PyramidChanges changes = update_parents(store, state, executor, [&](const auto& written) {
      for (const auto& [key, parent] : written) state.parents[key] = parent;
    });
    for (const TileKey key : changes.removed) state.parents.erase(key);
    return changes;
  }

  TileStore store;
  PyramidState state;
};

TEST(Pyramid, only_the_changed_quadrants_are_made_and_the_bytes_are_those_of_all) {
  const TempFolder folder;
  RecordedPyramid grown(folder / "grown");
  for (const TileKey key : kScattered) grown.write(key, key == TileKey{0, 5, 3} ? 99 : 0);
  grown.update();
  grown.write({0, 5, 3});
  const PyramidChanges changes = grown.update();
  EXPECT_EQ(changes.written.size(), 5u);  // levels 1 to 4 and the top
  EXPECT_EQ(changes.quadrants_made, 5);
  EXPECT_EQ(contents(folder / "grown"), built_at_once(folder / "at-once", kScattered));
}

TEST(Pyramid, unchanged_neighbours_are_not_even_read) {
  const TempFolder folder;
  RecordedPyramid map(folder / "map");
  const std::vector<TileKey> four = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {0, 4, 0}};
  for (const TileKey key : four) map.write(key);
  map.update();
  for (const char* layer : {"dem", "color", "confidence", "mask"})
    put_bytes(map.store.path({0, 1, 1}, layer), "no raster");
  map.write({0, 0, 0}, 99);
  const PyramidChanges changes = map.update();
  EXPECT_TRUE(changes.unreadable.empty());
  EXPECT_EQ(changes.written.front(), (TileKey{1, 0, 0}));
}

TEST(Pyramid, tile_that_cannot_be_read_is_named_and_nothing_is_made_above_it) {
  const TempFolder folder;
  RecordedPyramid map(folder / "map");
  for (const TileKey key : kScattered) map.write(key);
  put_bytes(map.store.path({0, 5, 3}, "dem"), "no raster");
  const PyramidChanges changes = map.update();
  EXPECT_EQ(changes.unreadable, std::vector<TileKey>{(TileKey{0, 5, 3})});
  EXPECT_FALSE(map.store.read(TileKey::top()));
  map.write({0, 5, 3});
  EXPECT_TRUE(map.update().unreadable.empty());
  EXPECT_EQ(contents(folder / "map"), built_at_once(folder / "at-once", kScattered));
}

TEST(Pyramid, parent_that_went_bad_is_made_again_from_all_its_children) {
  const TempFolder folder;
  RecordedPyramid map(folder / "map");
  for (const TileKey key : kScattered) map.write(key, key == TileKey{0, 4, -7} ? 99 : 0);
  map.update();
  put_bytes(map.store.path({1, 2, -4}, "color"), "no raster");
  map.write({0, 4, -7});
  EXPECT_TRUE(map.update().unreadable.empty());
  EXPECT_EQ(contents(folder / "map"), built_at_once(folder / "at-once", kScattered));
}

TEST(Pyramid, growing_over_the_top_discards_it_and_keeps_what_lies_below) {
  const TempFolder folder;
  RecordedPyramid map(folder / "map");
  for (const TileKey key : {TileKey{0, 0, 0}, TileKey{0, 1, 0}, TileKey{0, 2, 0}, TileKey{0, 3, 1}}) map.write(key);
  map.update();
  const std::string parent = file_bytes(map.store.path({1, 0, 0}, "dem"));
  map.write({0, -40, 25});
  const PyramidChanges changes = map.update();
  EXPECT_EQ(std::count(changes.written.begin(), changes.written.end(), TileKey{1, 0, 0}), 0);
  EXPECT_EQ(file_bytes(map.store.path({1, 0, 0}, "dem")), parent);
  map.store.remove({0, -40, 25});
  map.state.finest.erase({0, -40, 25});
  EXPECT_FALSE(map.update().removed.empty());
  EXPECT_TRUE(map.store.list_remains(2).empty());
}

TEST(Pyramid, parents_older_than_their_children_are_found_after_a_crash) {
  const TempFolder folder;
  built_at_once(folder.path(), kScattered);
  const TileStore store = store_in(folder.path());
  write_finest(store, {0, 5, 3}, 99);  // and the crash comes before the parents
  const auto before = contents(folder.path());
  update_parents(store);
  const auto repaired = contents(folder.path());
  EXPECT_NE(repaired, before);
  EXPECT_TRUE(update_parents(store).written.empty());
  EXPECT_EQ(contents(folder.path()), repaired);
}

TEST(Pyramid, parents_lost_in_a_crash_are_made_again) {
  const TempFolder folder;
  const auto expected = built_at_once(folder.path(), kScattered);
  const TileStore store = store_in(folder.path());
  for (const int level : {1, 3})
    for (const TileKey key : store.list(level)) store.remove(key);
  update_parents(store);
  EXPECT_EQ(contents(folder.path()), expected);
}

TEST(Pyramid, every_level_covers_the_ground_of_the_level_below) {
  const TempFolder folder;
  built_at_once(folder.path(), kScattered);
  const TileStore store = store_in(folder.path());
  const LevelPlan plan = plan_levels(-9, -7, 12, 11);
  for (int level = 1; level <= plan.highest_regular_level; ++level) {
    const std::vector<TileKey> parents = store.list(level);
    for (const TileKey child : store.list(level - 1))
      EXPECT_TRUE(std::binary_search(parents.begin(), parents.end(), child.parent())) << child.name();
  }
  EXPECT_TRUE(store.list(plan.highest_regular_level + 1).empty());
  EXPECT_TRUE(store.read(TileKey::top()).has_value());
}

// The top over a map of two tiles: its cells are means of 2 x 2 cells of theirs, in the right place.
TEST(Pyramid, top_of_a_small_map_holds_the_means_of_its_tiles) {
  const TempFolder folder;
  const TileStore store = store_in(folder.path());
  Tile tile = random_tile({0, -1, 0}, kCells);
  tile.dem = Array2d<float>(kCells, kCells, 5);
  store.write({0, -1, 0}, tile, "west");
  tile.dem = Array2d<float>(kCells, kCells, 9);
  store.write({0, 0, 0}, tile, "east");
  update_parents(store);
  const Tile top = store.read(TileKey::top()).value();
  EXPECT_EQ(top.dem(0, kCells - 1), 5.0f);
  EXPECT_EQ(top.dem(kCells / 2 - 1, kCells / 2), 5.0f);
  EXPECT_EQ(top.dem(kCells / 2, kCells / 2), 9.0f);
  EXPECT_TRUE(std::isnan(top.dem(0, 0))) << "nothing is known in the north";
}

}  // namespace
}  // namespace skysweep::tiles
