// SPDX-License-Identifier: Apache-2.0
// The loop with a clock of our own and a mapper that only writes down what it was asked for: no test sleeps.
#include "watch/watcher.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "raster/photo.h"
#include "raster/temp_folder.h"
#include "watch/quarantine.h"

namespace skysweep::watch {
namespace {

using testing_support::file_bytes;
using testing_support::put_bytes;
using Names = std::vector<std::string>;

const std::string kHeader = "image,x,y,z,yaw,pitch,roll,fx,fy,cx,cy,width,height\n";
std::string pose(const std::string& image, double x = 0) {
  return image + "," + std::to_string(x) + ",0,50,0,-90,0,10,10,8,6,16,12\n";
}

struct Batch {
  std::string project;
  Names photographs;
  bool operator==(const Batch&) const = default;
};

class WritingMapper final : public Mapper {
 public:
  pipeline::RunSummary update(const pipeline::RunRequest& request, pipeline::Progress&,
                              const std::atomic<bool>& stop) override {
    if (failure) throw *failure;
    if (meanwhile) meanwhile();
    batches.push_back({request.project.filename(), request.given->names});
    last = request;
    pipeline::RunSummary summary;
    summary.tiles_computed = 3;
    summary.interrupted = stop;
    for (const std::string& name : request.given->names) {
      index::ImageRecord record;
      record.name = name;
      if (bad.contains(name)) {
        record.status = index::ImageStatus::refused;
        record.reason = bad[name];
      }
      summary.images.push_back(record);
    }
    return summary;
  }
  void finish(const pipeline::RunRequest& request, const pipeline::RunSummary&) override {
    finished.push_back(request.project.filename());
  }

  std::vector<Batch> batches;
  Names finished;
  pipeline::RunRequest last;
  std::map<std::string, std::string> bad;
  std::optional<Error> failure;
  std::function<void()> meanwhile;
};

class Voice final : public pipeline::Progress {
 public:
  void warn(const std::string& sentence) override { warnings.push_back(sentence); }
  Names warnings;
};

// What is told when it is told.
class ToldEvents final : public FolderEvents {
 public:
  explicit ToldEvents(std::vector<FileEvent>& queue) : queue_(queue) {}
  std::vector<FileEvent> wait(double) override { return std::exchange(queue_, {}); }
  bool tells() const override { return true; }

 private:
  std::vector<FileEvent>& queue_;
};

class WatcherTest : public testing::Test {
 protected:
  WatcherTest() {
    std::filesystem::create_directories(in());
    request.run.images = in();
    request.run.project = root();
    request.settings.first = 2;
    photo_bytes = raster::encode_image("a.png", Array2d<Rgb8>(16, 12));
  }

  std::filesystem::path in() const { return folder / "in"; }
  std::filesystem::path root() const { return folder / "maps"; }

  Watcher& watcher() {
    if (!made)
      made = std::make_unique<Watcher>(
          request, Surroundings{mapper, voice, [this] { return std::make_unique<ToldEvents>(queue); },
                                [this] { return now_s; }, [this] { return 1e9 + now_s; }});
    return *made;
  }

  void photo(const std::string& name) { put_bytes(in() / name, photo_bytes); }
  // The same with an event, as when it is closed.
  void photo_arrives(const std::string& name) {
    photo(name);
    queue.push_back({FileEvent::Kind::closed, name});
  }
  void poses(const std::string& lines) { put_bytes(in() / "poses.csv", kHeader + lines); }

  void rounds(int count, double seconds = 1) {
    for (int i = 0; i < count; ++i, now_s += seconds) watcher().round(stop);
  }
  Names quarantined() {
    Names names;
    for (const auto& row : csv_rows(file_bytes(root() / "quarantine.csv")))
      if (row.front() != "file") names.push_back(row.front());
    return names;
  }

  testing_support::TempFolder folder;
  WatchRequest request;
  WritingMapper mapper;
  Voice voice;
  std::vector<FileEvent> queue;
  std::string photo_bytes;
  std::atomic<bool> stop{false};
  double now_s = 100;
  std::unique_ptr<Watcher> made;
};

TEST_F(WatcherTest, what_lies_there_is_taken_when_two_looks_found_it_the_same) {
  for (const char* name : {"a.png", "b.png"}) photo(name);
  poses(pose("a.png") + pose("b.png"));
  rounds(1);
  EXPECT_TRUE(mapper.batches.empty());
  rounds(2);
  ASSERT_EQ(mapper.batches, (std::vector<Batch>{{"map", {"a.png", "b.png"}}}));
  rounds(5);
  EXPECT_EQ(mapper.batches.size(), 1u) << "nothing new";
  EXPECT_EQ(watcher().status().mapped, 2);
  EXPECT_TRUE(watcher().idle() || mapper.finished.empty());
}

TEST_F(WatcherTest, what_arrives_first_waits_for_what_was_there_before) {
  for (const char* name : {"a.png", "b.png"}) photo(name);
  poses(pose("a.png") + pose("b.png") + pose("c.png") + pose("d.png"));
  for (const char* name : {"c.png", "d.png"}) photo_arrives(name);
  rounds(4);
  EXPECT_EQ(mapper.batches, (std::vector<Batch>{{"map", {"a.png", "b.png", "c.png", "d.png"}}}))
      << "a map of c and d alone would take a and b out of the project";
}

TEST_F(WatcherTest, a_batch_holds_all_that_arrived_while_the_last_was_in_work) {
  poses(pose("a.png") + pose("b.png") + pose("c.png") + pose("d.png"));
  rounds(3);
  for (const char* name : {"a.png", "b.png"}) photo_arrives(name);
  mapper.meanwhile = [&] {
    for (const char* name : {"c.png", "d.png"}) photo_arrives(name);
    mapper.meanwhile = nullptr;
  };
  rounds(4);
  EXPECT_EQ(mapper.batches,
            (std::vector<Batch>{{"map", {"a.png", "b.png"}}, {"map", {"a.png", "b.png", "c.png", "d.png"}}}));
}

TEST_F(WatcherTest, ten_thousand_files_dropped_at_once_are_one_batch) {
  rounds(3);
  std::string lines;
  for (int i = 0; i < 10000; ++i) {
    const std::string name = "drop/" + std::to_string(i) + ".png";
    photo(name);
    lines += pose(name, i);
  }
  poses(lines);
  queue.push_back({FileEvent::Kind::lost, ""});  // more than the kernel's queue holds
  rounds(4);
  ASSERT_EQ(mapper.batches.size(), 1u);
  EXPECT_EQ(mapper.batches.front().photographs.size(), 10000u);
  EXPECT_EQ(watcher().status().mapped, 10000);
}

TEST_F(WatcherTest, photographs_wait_for_poses_and_are_counted) {
  rounds(3);
  for (const char* name : {"a.png", "b.png", "c.png"}) photo_arrives(name);
  rounds(1);
  EXPECT_EQ(watcher().status().waiting_for_pose, 3);
  poses(pose("a.png") + pose("b.png") + pose("later.png"));
  queue.push_back({FileEvent::Kind::closed, "poses.csv"});
  rounds(2);
  EXPECT_EQ(mapper.batches, (std::vector<Batch>{{"map", {"a.png", "b.png"}}}));
  EXPECT_EQ(watcher().status().waiting_for_pose, 1);
  EXPECT_EQ(watcher().status().poses_waiting, 1);
}

TEST_F(WatcherTest, poses_that_a_logger_keeps_open_are_read_as_they_come) {
  rounds(3);
  for (const char* name : {"a.png", "b.png"}) photo_arrives(name);
  poses(pose("a.png") + pose("b.png") + "half.png,1");
  queue.push_back({FileEvent::Kind::written, "poses.csv"});
  rounds(2);
  EXPECT_EQ(mapper.batches, (std::vector<Batch>{{"map", {"a.png", "b.png"}}}));
}

TEST_F(WatcherTest, a_corrected_pose_and_a_file_sent_again_are_batches_of_their_own) {
  for (const char* name : {"a.png", "b.png"}) photo(name);
  poses(pose("a.png") + pose("b.png"));
  rounds(3);
  poses(pose("a.png", 5) + pose("b.png"));
  rounds(2);
  ASSERT_EQ(mapper.batches.size(), 2u);
  EXPECT_EQ(mapper.last.given->poses.images.front().pose.center.x, 5);
  photo_arrives("a.png");
  rounds(2);
  EXPECT_EQ(mapper.batches.size(), 3u) << "its tiles may have been made while it was half there";
}

TEST_F(WatcherTest, a_batch_waits_for_a_photograph_that_is_being_sent_again_but_not_for_ever) {
  poses(pose("a.png") + pose("b.png") + pose("c.png") + pose("d.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  rounds(3);
  ASSERT_EQ(mapper.batches.size(), 1u);
  queue.push_back({FileEvent::Kind::written, "a.png"});
  photo_arrives("c.png");
  rounds(3);
  EXPECT_EQ(mapper.batches.size(), 1u) << "its tiles would be made without a";
  photo_arrives("a.png");
  rounds(1);
  EXPECT_EQ(mapper.batches.size(), 2u);

  queue.push_back({FileEvent::Kind::written, "a.png"});
  photo_arrives("d.png");
  rounds(9);
  EXPECT_EQ(mapper.batches.size(), 2u);
  rounds(3);
  EXPECT_EQ(mapper.batches.size(), 3u);
}

TEST_F(WatcherTest, a_map_is_begun_with_enough_photographs) {
  request.settings.first = 3;
  poses(pose("a.png") + pose("b.png") + pose("c.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  rounds(5);
  EXPECT_TRUE(mapper.batches.empty());
  EXPECT_EQ(watcher().status().groups.at(0).state, "waiting");
  photo_arrives("c.png");
  rounds(1);
  EXPECT_EQ(mapper.batches.size(), 1u);
}

TEST_F(WatcherTest, once_takes_what_is_there_however_little_and_then_has_nothing_to_do) {
  request.settings.first = 30;
  request.once = true;
  poses(pose("a.png") + pose("b.png").substr(0, pose("b.png").size() - 1));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  std::atomic<bool> reload{false};
  int shown = 0;
  watch(watcher(), true, stop, reload, [&] {
    ++shown;
    now_s += 1;
  });
  EXPECT_EQ(mapper.batches, (std::vector<Batch>{{"map", {"a.png", "b.png"}}}));
  EXPECT_EQ(mapper.finished, Names{"map"});
  EXPECT_GT(shown, 2);
  EXPECT_TRUE(std::filesystem::exists(root() / "status.json"));
}

TEST_F(WatcherTest, broken_files_are_named_with_a_reason_and_taken_when_they_come_whole) {
  poses(pose("a.png") + pose("b.png") + pose("cut.png") + pose("odd \"name\",\n.png"));
  for (const char* name : {"a.png", "b.png", "odd \"name\",\n.png"}) photo(name);
  put_bytes(in() / "cut.png", photo_bytes.substr(0, photo_bytes.size() - 20));
  put_bytes(in() / "text.jpg", "this is a text");
  put_bytes(in() / "empty.jpg", "");
  mapper.bad["b.png"] = "b.png is damaged: it cannot be decoded";
  rounds(4);
  EXPECT_EQ(mapper.batches.size(), 1u);
  EXPECT_EQ(quarantined(), (Names{"b.png", "cut.png", "empty.jpg", "text.jpg"}));
  EXPECT_EQ(watcher().status().quarantined, 4);
  EXPECT_NE(file_bytes(root() / "quarantine.csv").find("cut off before its end"), std::string::npos);

  photo_arrives("cut.png");
  mapper.bad.clear();
  photo_arrives("b.png");
  rounds(2);
  EXPECT_EQ(mapper.batches.back().photographs.size(), 3u);
  EXPECT_EQ(quarantined(), (Names{"empty.jpg", "text.jpg"}));
  std::filesystem::remove(in() / "text.jpg");
  queue.push_back({FileEvent::Kind::gone, "text.jpg"});
  rounds(2);
  EXPECT_EQ(quarantined(), Names{"empty.jpg"});
}

TEST_F(WatcherTest, groups_have_projects_of_their_own) {
  request.settings.group = GroupRule::folder;
  put_bytes(in() / "f1/poses.csv", kHeader + pose("a.png") + pose("b.png"));
  put_bytes(in() / "f2/poses.csv", kHeader + pose("a.png") + pose("b.png"));
  for (const char* name : {"f1/a.png", "f1/b.png", "f2/a.png", "f2/b.png"}) photo(name);
  rounds(5);
  EXPECT_EQ(mapper.batches, (std::vector<Batch>{{"f1", {"f1/a.png", "f1/b.png"}}, {"f2", {"f2/a.png", "f2/b.png"}}}));
  EXPECT_EQ(file_bytes(root() / "groups.csv"),
            "photograph,group\nf1/a.png,f1\nf1/b.png,f1\nf2/a.png,f2\nf2/b.png,f2\n");
}

TEST_F(WatcherTest, two_places_that_turn_out_to_be_one_become_one_map) {
  request.settings.group = GroupRule::distance;
  request.settings.group_gap = 100;
  poses(pose("a.png", 0) + pose("b.png", 50) + pose("c.png", 240) + pose("d.png", 280) + pose("e.png", 145));
  for (const char* name : {"a.png", "b.png", "c.png", "d.png"}) photo(name);
  rounds(5);
  EXPECT_EQ(mapper.batches.size(), 2u);
  photo_arrives("e.png");
  rounds(2);
  EXPECT_EQ(mapper.batches.back(), (Batch{"x0y0", {"a.png", "b.png", "c.png", "d.png", "e.png"}}));
  const Status status = watcher().status();
  EXPECT_EQ(status.groups.at(1).state, "left as it is");
  EXPECT_EQ(status.groups.at(1).reason, "Its photographs became part of x0y0.");
}

TEST_F(WatcherTest, without_a_time_no_grouping_by_time) {
  request.settings.group = GroupRule::time;
  poses(pose("a.png"));
  photo("a.png");
  rounds(4);
  EXPECT_TRUE(mapper.batches.empty());
  EXPECT_EQ(quarantined(), Names{"a.png"});
}

TEST_F(WatcherTest, a_photograph_taken_away_leaves_the_map_and_an_emptied_folder_changes_nothing) {
  poses(pose("a.png") + pose("b.png") + pose("c.png"));
  for (const char* name : {"a.png", "b.png", "c.png"}) photo(name);
  rounds(4);
  std::filesystem::remove(in() / "c.png");
  queue.push_back({FileEvent::Kind::gone, "c.png"});
  rounds(2);
  EXPECT_EQ(mapper.batches.back(), (Batch{"map", {"a.png", "b.png"}}));
  const std::size_t before = mapper.batches.size();
  std::filesystem::rename(in(), folder / "unmounted");
  queue.push_back({FileEvent::Kind::lost, ""});
  rounds(3);
  EXPECT_EQ(mapper.batches.size(), before);
  EXPECT_EQ(watcher().status().photographs, 2);
  EXPECT_EQ(watcher().status().troubles.size(), 1u);
  std::filesystem::create_directories(in());
  rounds(3);
  EXPECT_EQ(mapper.batches.size(), before) << "a mount point without its disk";
  std::filesystem::remove_all(in());
  std::filesystem::rename(folder / "unmounted", in());
  rounds(3);
  EXPECT_TRUE(watcher().status().troubles.empty());
  EXPECT_EQ(watcher().status().mapped, 2);
}

TEST_F(WatcherTest, trouble_with_the_disk_is_tried_again_and_trouble_with_photographs_waits_for_others) {
  poses(pose("a.png") + pose("b.png") + pose("c.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  mapper.failure = failure("No space left.");
  rounds(5);
  EXPECT_EQ(watcher().status().groups.at(0).reason, "No space left.");
  mapper.failure.reset();
  rounds(1);
  EXPECT_TRUE(mapper.batches.empty()) << "not before ten seconds";
  now_s += 10;
  rounds(2);
  EXPECT_EQ(mapper.batches.size(), 1u);
  EXPECT_TRUE(watcher().status().troubles.empty());

  mapper.failure = bad_input("No overlap.");
  photo_arrives("c.png");
  rounds(1);
  mapper.failure.reset();
  rounds(30);
  EXPECT_EQ(mapper.batches.size(), 1u);
  photo_arrives("c.png");
  rounds(1);
  EXPECT_EQ(mapper.batches.size(), 2u);
  mapper.failure = usage_error("Another cell.");
  photo_arrives("c.png");
  EXPECT_THROW(rounds(1), Error) << "a contradiction is for the operator";
}

TEST_F(WatcherTest, maps_are_finished_when_nothing_has_come_for_ten_seconds) {
  poses(pose("a.png") + pose("b.png") + pose("c.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  rounds(5);
  photo_arrives("c.png");
  rounds(9);
  EXPECT_TRUE(mapper.finished.empty());
  rounds(4);
  EXPECT_EQ(mapper.finished, Names{"map"}) << "once for both batches";
}

TEST_F(WatcherTest, an_interrupted_batch_is_due_when_the_watcher_comes_back) {
  poses(pose("a.png") + pose("b.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  mapper.meanwhile = [&] { stop = true; };
  rounds(4);
  EXPECT_EQ(mapper.batches.size(), 1u) << "after the stop nothing is begun";
  EXPECT_EQ(watcher().status().mapped, 0);
  made.reset();
  stop = false;
  mapper.meanwhile = nullptr;
  rounds(4);
  EXPECT_EQ(mapper.batches.size(), 2u);
  EXPECT_EQ(watcher().status().mapped, 2);
}

TEST_F(WatcherTest, reloading_takes_other_settings_and_keeps_the_old_ones_if_the_file_is_wrong) {
  request.settings_file = folder / "watch.toml";
  put_bytes(folder / "watch.toml", "[watch]\nfirst = 4\n");
  poses(pose("a.png") + pose("b.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  rounds(5);
  EXPECT_TRUE(mapper.batches.empty());
  put_bytes(folder / "watch.toml", "[watch]\nfirst = \"two\"\n");
  watcher().reload();
  rounds(3);
  EXPECT_TRUE(mapper.batches.empty());
  EXPECT_EQ(watcher().status().troubles.size(), 1u);
  put_bytes(folder / "watch.toml", "[watch]\nfirst = 2\nthreads = 7\nmemory_mib = 100\npoll_seconds = 3\n");
  watcher().reload();
  rounds(3, 3);
  ASSERT_EQ(mapper.batches.size(), 1u);
  EXPECT_EQ(mapper.last.threads, 7);
  EXPECT_EQ(mapper.last.memory_bytes, std::size_t{100} << 20);
  EXPECT_EQ(watcher().status().looks_by, "polling");
  EXPECT_TRUE(watcher().status().troubles.empty());
}

TEST_F(WatcherTest, polling_asks_for_no_events) {
  request.settings.poll_s = 5;
  poses(pose("a.png") + pose("b.png"));
  for (const char* name : {"a.png", "b.png"}) photo(name);
  EXPECT_EQ(watcher().status().looks_by, "");
  rounds(1);
  EXPECT_EQ(watcher().status().looks_by, "polling");
  now_s += 5;
  rounds(1);
  EXPECT_EQ(mapper.batches.size(), 1u);
}

TEST_F(WatcherTest, folders_in_one_another_and_missing_ones_are_refused) {
  const auto refusal = [&](const std::filesystem::path& from, const std::filesystem::path& to) {
    WatchRequest other = request;
    other.run.images = from;
    other.run.project = to;
    return testing_support::message_of<Error>([&] {
      const Watcher second(other,
                           Surroundings{mapper, voice, [] { return nullptr; }, [] { return 0.0; }, [] { return 0.0; }});
    });
  };
  EXPECT_NE(refusal(in(), in() / "maps").find("must not lie in one another"), std::string::npos);
  EXPECT_NE(refusal(in(), in()).find("must not lie in one another"), std::string::npos);
  EXPECT_NE(refusal(in(), folder.path()).find("must not lie in one another"), std::string::npos);
  EXPECT_NE(refusal(folder / "missing", root()).find("does not exist"), std::string::npos);
}

}  // namespace
}  // namespace skysweep::watch
