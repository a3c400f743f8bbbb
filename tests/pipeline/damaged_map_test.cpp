// SPDX-License-Identifier: Apache-2.0
// Damage that sizes and times do not show, and what a quick look relies on.
#include <filesystem>

#include "index/catalogue.h"
#include "laws/small_flight.h"
#include "pipeline/photographs.h"
#include "raster/file_stamp.h"

namespace skysweep::pipeline {
namespace {

namespace fs = std::filesystem;
using laws::expect_same_files;
using laws::file_bytes;
using laws::put_bytes;
using laws::tile_files;

class DamagedMap : public laws::SmallFlight {
 protected:
  void SetUp() override {
    run(request("map"));
    before = tile_files(request("map"));
  }

  index::Catalogue catalogue() const {
    return index::Catalogue::open_existing(ProjectPaths(request("map").project).catalogue());
  }

  // Changes a byte of a tile's file such that its sizes and times are those in the catalogue, as a failing disk does.
  void rot(tiles::TileKey key, const std::string& layer, std::size_t at) const {
    const tiles::TileStore tiles = store(request("map"));
    std::string bytes = file_bytes(tiles.path(key, layer));
    bytes[at % bytes.size()] = static_cast<char>(bytes[at % bytes.size()] ^ 0x40);
    put_bytes(tiles.path(key, layer), bytes);
    index::Catalogue file = catalogue();
    for (index::TileRecord row : file.tiles()) {
      if (row.name != key.name()) continue;
      row.stamp = tiles.stamp(key).value();
      file.put_tiles({row});
    }
  }

  tiles::TileKey some_tile() const { return store(request("map")).list(0).at(3); }

  laws::TileFiles before;
};

TEST_F(DamagedMap, rot_that_no_size_or_time_shows_is_found_by_verify) {
  const tiles::TileKey tile = some_tile(), parent = tile.parent();
  rot(tile, "mask", 100000);
  rot(parent, "color", 100000);
  const laws::TileFiles rotten = tile_files(request("map"));
  ASSERT_NE(rotten, before);
  EXPECT_EQ(run(request("map")).tiles_computed, 0);
  EXPECT_EQ(tile_files(request("map")), rotten);
  RunRequest verify = request("map");
  verify.verify = true;
  EXPECT_EQ(run(verify).tiles_computed, 1);
  expect_same_files(before, tile_files(request("map")));
}

TEST_F(DamagedMap, rot_in_a_tile_that_a_parent_needs_is_found_when_it_is_read) {
  const tiles::TileKey tile = some_tile();
  const tiles::TileStore tiles = store(request("map"));
  rot(tile, "dem", file_bytes(tiles.path(tile, "dem")).size() / 2);
  for (const char* layer : {"dem", "dem_max", "color", "confidence", "mask"})
    fs::remove(tiles.path(tile.parent(), layer));
  EXPECT_EQ(run(request("map")).tiles_computed, 1);
  expect_same_files(before, tile_files(request("map")));
}

// The same outside the area that the run was asked for: a hole in the map is not left because nobody looked there.
TEST_F(DamagedMap, rot_in_a_tile_that_a_parent_needs_is_repaired_wherever_it_lies) {
  const tiles::TileKey tile = some_tile();
  const tiles::TileStore tiles = store(request("map"));
  rot(tile, "dem", file_bytes(tiles.path(tile, "dem")).size() / 2);
  for (const char* layer : {"dem", "dem_max", "color", "confidence", "mask"})
    fs::remove(tiles.path(tile.parent(), layer));
  RunRequest elsewhere = request("map");
  elsewhere.area = Box2d{{tiles.lattice().extent(tile).max.x + 1, -100}, {100, 100}};
  EXPECT_EQ(run(elsewhere).tiles_computed, 1);
  expect_same_files(before, tile_files(request("map")));
}

TEST_F(DamagedMap, files_of_tiles_that_no_photograph_touches_are_removed) {
  const tiles::TileStore tiles = store(request("map"));
  tiles::Tile stranger = tiles.read(some_tile()).value();
  tiles.write({0, 77, -33}, stranger, "of another project");
  EXPECT_EQ(run(request("map")).tiles_removed, 1);
  expect_same_files(before, tile_files(request("map")));
}

TEST_F(DamagedMap, temporary_files_of_a_crash_are_swept_away) {
  put_bytes(request("map").project / "tiles/dem/l0/.y1.skysweep-part1-1.tif", "torn");
  run(request("map"));
  expect_same_files(before, tile_files(request("map")));
}

// The catalogue says of a photograph what its size and times do not contradict.
TEST_F(DamagedMap, verify_believes_no_record_of_a_photograph) {
  const auto misremember = [&] {
    index::Catalogue file = catalogue();
    index::ImageRecord image = file.images().front();
    image.content_digest = "of other bytes";
    image.stamp = raster::file_stamp(request("map").images / image.name).value();
    file.put_images({image});
  };
  misremember();
  RunRequest verify = request("map");
  verify.verify = true;
  EXPECT_EQ(run(verify).tiles_computed, 0);
  misremember();
  EXPECT_GT(run(request("map")).tiles_computed, 0);
}

TEST_F(DamagedMap, photograph_that_nobody_touched_is_not_read_again) {
  const RunRequest r = request("map");
  SerialExecutor executor;
  PhotographSet first = collect_photographs(r.images, r.poses, {}, {}, executor);
  const std::string digest = first.records[0].content_digest;
  std::vector<index::ImageRecord> known = first.records;
  known[0].stamp = raster::file_stamp(r.images / known[0].name).value();
  known[0].content_digest = "as if of these bytes";
  EXPECT_EQ(collect_photographs(r.images, r.poses, {}, {}, executor, known).records[0].content_digest,
            "as if of these bytes");
  put_bytes(r.images / known[0].name, file_bytes(r.images / known[0].name));
  EXPECT_EQ(collect_photographs(r.images, r.poses, {}, {}, executor, known).records[0].content_digest, digest);
}

}  // namespace
}  // namespace skysweep::pipeline
