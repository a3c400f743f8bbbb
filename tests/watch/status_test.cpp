// SPDX-License-Identifier: Apache-2.0
#include "watch/status.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "raster/temp_folder.h"
#include "watch/status_board.h"

namespace skysweep::watch {
namespace {

Status example() {
  Status s;
  s.state = "mapping flight1";
  s.looks_by = "events";
  s.photographs = 12;
  s.arriving = 2;
  s.waiting_for_pose = 3;
  s.poses_waiting = 4;
  s.due = 5;
  s.mapped = 4;
  s.quarantined = 1;
  s.batches = 7;
  s.stage = "tiles";
  s.stage_done = 3;
  s.stage_total = 9;
  s.median_seconds_to_tiles = 2.5;
  s.groups = {{"flight1", 9, 40, "being mapped", ""}, {"odd \"name\"", 1, 0, "waiting", "Too few."}};
  return s;
}

TEST(Status, as_a_line) {
  EXPECT_EQ(status_line(example()),
            "mapping flight1, tiles 3/9: 4 of 12 photographs in 2 maps, 5 due, 3 without pose, 4 poses without "
            "photograph, 2 arriving, 1 in quarantine");
}

TEST(Status, as_json) {
  const auto json = nlohmann::json::parse(status_json(example(), 1234567890.7));
  EXPECT_EQ(json.at("updated"), 1234567890);
  EXPECT_EQ(json.at("mapped"), 4);
  EXPECT_EQ(json.at("stage").at("done"), 3);
  EXPECT_EQ(json.at("median_seconds_to_tiles"), 2.5);
  EXPECT_EQ(json.at("groups").at(1).at("reason"), "Too few.");
  Status odd = example();
  odd.groups[0].name = "not \xff UTF-8";
  EXPECT_NO_THROW(nlohmann::json::parse(status_json(odd, 0)));
}

TEST(Status, as_prometheus_reads_it) {
  const std::string text = prometheus_text(example());
  for (const char* sample :
       {"\nskysweep_watch_photographs{state=\"mapped\"} 4\n", "\nskysweep_watch_photographs{state=\"due\"} 5\n",
        "# TYPE skysweep_watch_batches_total counter\nskysweep_watch_batches_total 7\n",
        "\nskysweep_watch_median_seconds_to_tiles 2.5\n", "\nskysweep_watch_tiles_total{group=\"flight1\"} 40\n",
        "\nskysweep_watch_tiles_total{group=\"odd \\\"name\\\"\"} 0\n", "\nskysweep_watch_mapping 1\n"})
    EXPECT_NE(text.find(sample), std::string::npos) << sample << "is not in\n" << text;
}

class CountingProgress : public pipeline::Progress {
 public:
  void warn(const std::string&) override { ++warnings; }
  void note(const std::string&) override { ++notes; }
  int warnings = 0, notes = 0;
};

TEST(StatusBoard, writes_a_change_at_once_a_stage_each_second_and_a_sign_of_life_each_ten) {
  const testing_support::TempFolder folder;
  const auto file = folder / "status.json";
  CountingProgress progress;
  double now_s = 1000;
  StatusBoard board(file, progress, [&] { return now_s; });
  const auto written = [&] {
    const bool is_there = std::filesystem::remove(file);
    return is_there;
  };
  board.write_if_due();
  EXPECT_TRUE(written());
  board.write_if_due();
  EXPECT_FALSE(written());
  Status status;
  status.mapped = 1;
  board.set(status);
  board.write_if_due();
  EXPECT_TRUE(written());
  board.begin("tiles", 2);
  EXPECT_FALSE(written());
  now_s += 1;
  board.advance();
  EXPECT_TRUE(written());
  EXPECT_EQ(board.status().stage_done, 1);
  now_s += 10;
  board.write_if_due();
  EXPECT_TRUE(written());
  now_s -= 5000;
  board.write_if_due();
  EXPECT_TRUE(written()) << "although the clock was set back";
}

TEST(StatusBoard, warns_of_a_thing_once) {
  const testing_support::TempFolder folder;
  CountingProgress progress;
  StatusBoard board(folder / "status.json", progress, [] { return 0.0; });
  for (int i = 0; i < 3; ++i) board.warn("a.jpg is damaged");
  EXPECT_EQ(progress.warnings, 1);
  EXPECT_EQ(progress.notes, 2);
}

}  // namespace
}  // namespace skysweep::watch
