// SPDX-License-Identifier: Apache-2.0
// Law: a map that grows is the map that is made at once. However photographs come, go and come back, in whatever order
// and on however many threads, every file of every level has the same bytes, given equal project.toml.
#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "index/catalogue.h"
#include "laws/small_flight.h"

namespace skysweep::laws {
namespace {

namespace fs = std::filesystem;

class GrowthLaw : public SmallFlight {
 protected:
  GrowthLaw() {
    for (const auto& entry : fs::directory_iterator(request("").images)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    run(request("at_once"));
    expected = tile_files(request("at_once"));
  }

  // A project of its own that is fed from a folder of its own.
  pipeline::RunRequest grown(const std::string& project, int threads = 1) {
    pipeline::RunRequest r = request(project);
    r.images = folder / (project + "_images");
    r.threads = threads;
    fs::create_directories(r.images);
    // What is derived from the data is fixed when a project is made.
    put_bytes(pipeline::ProjectPaths(r.project).settings(),
              file_bytes(pipeline::ProjectPaths(request("at_once").project).settings()));
    return r;
  }

  void add(const pipeline::RunRequest& r, const std::string& name) const {
    fs::copy_file(request("").images / name, r.images / name, fs::copy_options::overwrite_existing);
  }
  static void take_away(const pipeline::RunRequest& r, const std::string& name) { fs::remove(r.images / name); }

  // One photograph after the other; a map needs two to begin with.
  void feed(const pipeline::RunRequest& r, const std::vector<std::string>& order) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      add(r, order[i]);
      if (i > 0) run(r);
    }
  }

  std::vector<std::string> names;
  TileFiles expected;
};

TEST_F(GrowthLaw, one_photograph_after_the_other_in_any_order_gives_the_bytes_of_all_at_once) {
  ASSERT_GE(names.size(), 6u);
  std::vector<std::string> reversed(names.rbegin(), names.rend()), shuffled = names;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(11));
  const std::pair<const char*, std::vector<std::string>> orders[] = {
      {"forward", names}, {"reversed", reversed}, {"shuffled", shuffled}};
  for (const auto& [name, order] : orders)
    for (const int threads : {1, 2}) {
      SCOPED_TRACE(std::string(name) + " on " + std::to_string(threads));
      const pipeline::RunRequest r = grown(name + std::to_string(threads), threads);
      feed(r, order);
      expect_same_files(expected, tile_files(r));
    }
}

TEST_F(GrowthLaw, photographs_that_come_and_go_leave_no_trace) {
  for (const int threads : {1, 2}) {
    SCOPED_TRACE(threads);
    const pipeline::RunRequest r = grown("restless" + std::to_string(threads), threads);
    std::mt19937 random(23);
    std::set<std::string> there;
    for (int step = 0; step < 8; ++step) {
      for (const std::string& name : names) {
        if (random() % 2 == 0) continue;
        if (there.contains(name)) {
          take_away(r, name);
          there.erase(name);
        } else {
          add(r, name);
          there.insert(name);
        }
      }
      if (there.size() >= 2) run(r);
    }
    for (const std::string& name : names) add(r, name);
    run(r);
    expect_same_files(expected, tile_files(r));
  }
}

TEST_F(GrowthLaw, removed_by_name_is_as_if_it_had_never_been_there_and_restored_as_if_it_had_never_gone) {
  const std::string gone = names[names.size() / 2];
  pipeline::RunRequest without = grown("without");
  for (const std::string& name : names)
    if (name != gone) add(without, name);
  run(without);

  pipeline::RunRequest r = grown("removing");
  for (const std::string& name : names) add(r, name);
  run(r);
  expect_same_files(expected, tile_files(r));
  r.remove = {gone};
  run(r);
  expect_same_files(tile_files(without), tile_files(r));
  r.remove.clear();
  const pipeline::RunSummary again = run(r);
  EXPECT_EQ(again.tiles_computed, 0) << "a removal outlives the run that asked for it";
  r.restore = {gone};
  run(r);
  expect_same_files(expected, tile_files(r));
}

TEST_F(GrowthLaw, replaced_and_moved_photographs_give_the_bytes_of_a_map_made_of_them) {
  const std::string replaced = names[1], posed = names[3];
  const auto spoil = [&](const pipeline::RunRequest& r) {
    std::string bytes = file_bytes(r.images / names[0]);  // another photograph under the old name
    put_bytes(r.images / replaced, bytes);
  };
  std::string poses = file_bytes(request("").poses);
  const std::size_t line = poses.find(posed);
  const std::size_t x = poses.find(',', line) + 1, end = poses.find(',', x);
  poses.replace(x, end - x, std::to_string(std::stod(poses.substr(x, end - x)) + 0.05));
  put_bytes(folder / "moved.csv", poses);

  pipeline::RunRequest at_once = grown("new_at_once");
  for (const std::string& name : names) add(at_once, name);
  spoil(at_once);
  at_once.poses = folder / "moved.csv";
  run(at_once);

  pipeline::RunRequest r = grown("changing");
  for (const std::string& name : names) add(r, name);
  run(r);
  ASSERT_NE(tile_files(r), tile_files(at_once));
  spoil(r);
  run(r);
  r.poses = folder / "moved.csv";
  run(r);
  expect_same_files(tile_files(at_once), tile_files(r));
  r.poses = request("").poses;
  add(r, replaced);
  run(r);
  expect_same_files(expected, tile_files(r));
}

// A photograph that may show a tile, but does not serve it, costs it nothing but a look.
TEST_F(GrowthLaw, only_tiles_that_a_photograph_serves_are_computed_again) {
  write_tile_settings("[views]\nviews_per_place = 2\nmax_views = 3\n");  // so that some are left over
  pipeline::RunRequest r = request("frugal");
  r.images = folder / "frugal_images";
  fs::create_directories(r.images);
  const auto candidates = [&] {
    std::map<std::string, std::string> digests;
    for (const index::TileRecord& row :
         index::Catalogue::open_existing(pipeline::ProjectPaths(r.project).catalogue()).tiles())
      if (row.level == 0) digests[row.name] = row.candidates_digest;
    return digests;
  };
  for (std::size_t i = 0; i + 1 < names.size(); ++i) add(r, names[i]);
  const pipeline::RunSummary first = run(r);
  const auto before = candidates();
  add(r, names.back());
  const pipeline::RunSummary second = run(r);
  int looked_at = 0;
  for (const auto& [name, digest] : candidates()) looked_at += !before.contains(name) || before.at(name) != digest;
  EXPECT_GT(second.tiles_computed, 0);
  EXPECT_LT(second.tiles_computed, looked_at);
  EXPECT_LT(looked_at, first.tiles_planned);
  EXPECT_EQ(run(r).tiles_computed, 0);
  // What was spared would have come out the same.
  pipeline::RunRequest at_once = r;
  at_once.project = folder / "frugal_at_once";
  put_bytes(pipeline::ProjectPaths(at_once.project).settings(),
            file_bytes(pipeline::ProjectPaths(r.project).settings()));
  run(at_once);
  expect_same_files(tile_files(at_once), tile_files(r));
}

}  // namespace
}  // namespace skysweep::laws
