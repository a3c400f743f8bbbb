// SPDX-License-Identifier: Apache-2.0
// Law: a tile is a pure function of the photographs that touch it, their poses and the configuration. However the work
// is divided, ordered or interrupted, every tile file of every level has the same bytes.
#include <algorithm>
#include <fstream>
#include <random>
#include <vector>

#include "laws/small_flight.h"

namespace skysweep::laws {
namespace {

namespace fs = std::filesystem;

class PurityLaw : public SmallFlight {
 protected:
  // What everything is compared with: one run on one thread.
  TileFiles reference() {
    const pipeline::RunSummary summary = run(request("reference"));
    EXPECT_GE(summary.tiles_computed, 6) << "too few tiles to divide, order or interrupt anything";
    EXPECT_GE(summary.parents_written, 3);
    return tile_files(request("reference"));
  }
};

// Raises the stop flag after so many tiles.
class StopAfter : public pipeline::Progress {
 public:
  explicit StopAfter(int tiles) : tiles_left_(tiles) {}
  void begin(const std::string& stage, int) override { in_tiles_ = stage == "tiles"; }
  void advance() override {
    if (in_tiles_ && --tiles_left_ == 0) stop = true;
  }
  std::atomic<bool> stop{false};

 private:
  std::atomic<bool> in_tiles_{false};
  std::atomic<int> tiles_left_;
};

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// Photographs of `from`, made in `to` in this order; at most `count` of them.
void copy_photographs(std::vector<fs::path> photographs, const fs::path& to, std::size_t count) {
  fs::create_directories(to);
  photographs.resize(std::min(count, photographs.size()));
  for (const fs::path& photograph : photographs) fs::copy_file(photograph, to / photograph.filename());
}

std::vector<fs::path> photographs_in(const fs::path& images) {
  std::vector<fs::path> photographs;
  for (const auto& entry : fs::directory_iterator(images)) photographs.push_back(entry.path());
  std::sort(photographs.begin(), photographs.end());
  return photographs;
}

TEST_F(PurityLaw, any_number_of_threads_gives_the_same_bytes) {
  const TileFiles expected = reference();
  for (const int threads : {2, 5}) {
    pipeline::RunRequest r = request("threads" + std::to_string(threads));
    r.threads = threads;
    run(r);
    SCOPED_TRACE(threads);
    expect_same_files(expected, tile_files(r));
  }
}

TEST_F(PurityLaw, any_order_of_photographs_and_poses_gives_the_same_bytes) {
  const TileFiles expected = reference();
  pipeline::RunRequest r = request("shuffled");

  std::mt19937 random(7);
  std::vector<std::string> rows = lines_of(r.poses);
  const auto first_row = std::find_if(rows.begin(), rows.end(), [](const std::string& s) { return s[0] != '#'; }) + 1;
  std::shuffle(first_row, rows.end(), random);
  ASSERT_NE(joined(rows), joined(lines_of(r.poses)));
  put_bytes(folder / "shuffled.csv", joined(rows));

  std::vector<fs::path> photographs = photographs_in(r.images);
  std::shuffle(photographs.begin(), photographs.end(), random);
  copy_photographs(photographs, folder / "shuffled_images", photographs.size());

  r.poses = folder / "shuffled.csv";
  r.images = folder / "shuffled_images";
  run(r);
  expect_same_files(expected, tile_files(r));
}

TEST_F(PurityLaw, interrupted_and_resumed_gives_the_same_bytes) {
  const TileFiles expected = reference();
  const pipeline::RunRequest r = request("interrupted");
  StopAfter stop_after(8);
  const pipeline::RunSummary first = pipeline::run(r, stop_after, stop_after.stop);
  ASSERT_TRUE(first.interrupted);
  ASSERT_LT(first.tiles_computed, first.tiles_planned);
  ASSERT_NE(tile_files(r), expected);

  const pipeline::RunSummary second = run(r);
  EXPECT_EQ(second.tiles_kept, first.tiles_computed) << "work was thrown away";
  expect_same_files(expected, tile_files(r));
}

TEST_F(PurityLaw, two_halves_of_the_area_give_the_same_bytes_as_the_whole) {
  const TileFiles expected = reference();
  pipeline::RunRequest r = request("halves");
  r.area = Box2d{{8, -100}, {100, 100}};
  const pipeline::RunSummary east = run(r);
  ASSERT_LT(tile_files(r).size(), expected.size());
  r.area = Box2d{{-100, -100}, {8, 100}};
  const pipeline::RunSummary west = run(r);
  EXPECT_GT(east.tiles_computed, 0);
  EXPECT_GT(west.tiles_computed, 0);
  expect_same_files(expected, tile_files(r));
}

TEST_F(PurityLaw, photographs_that_arrive_later_give_the_same_bytes) {
  const TileFiles expected = reference();
  pipeline::RunRequest r = request("incremental");
  // What is derived from the data is fixed when a project is made.
  put_bytes(pipeline::ProjectPaths(r.project).settings(),
            file_bytes(pipeline::ProjectPaths(request("reference").project).settings()));
  const std::vector<fs::path> photographs = photographs_in(r.images);
  copy_photographs(photographs, folder / "early", photographs.size() / 2);
  r.images = folder / "early";
  run(r);
  ASSERT_NE(tile_files(r), expected);
  r.images = request("reference").images;
  run(r);
  expect_same_files(expected, tile_files(r));
}

}  // namespace
}  // namespace skysweep::laws
