// SPDX-License-Identifier: Apache-2.0
#include "pipeline/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/random.h"
#include "pipeline/tile_digest.h"

namespace skysweep::pipeline {
namespace {

ProjectSettings settings() {
  ProjectSettings s;
  s.lattice = {256, 0.1, 0.05};
  s.configuration.tiles.cells = 256;
  s.search = {50, 50, 25, 75, {}};
  s.crs_wkt = "a field";
  return s;
}

std::vector<index::ImageRecord> photographs(int count, Vec2d middle) {
  Random random(5);
  std::vector<index::ImageRecord> records(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    index::ImageRecord& record = records[static_cast<std::size_t>(i)];
    record.name = "IMG_" + std::to_string(100 + i);
    record.model = {1000, 800, 900, 900, 500, 400, {}};
    record.pose = {camera::rotation_from_yaw_pitch_roll(random.uniform(-180, 180), random.uniform(-90, -85), 0),
                   camera::snap_position({middle.x + random.uniform(-80, 80), middle.y + random.uniform(-80, 80),
                                          50 + random.uniform(-3, 3)})};
    record.content_digest = std::to_string(random.next());
  }
  return records;
}

void expect_same(const Coverage& a, const Coverage& b) {
  const std::vector<tiles::TileKey> keys = a.tiles(std::nullopt);
  ASSERT_EQ(keys, b.tiles(std::nullopt));
  for (const tiles::TileKey key : keys) {
    EXPECT_EQ(a.candidates(key), b.candidates(key)) << key.name();
    EXPECT_EQ(a.candidates_digest(key, "s"), b.candidates_digest(key, "s")) << key.name();
  }
}

TEST(Coverage, does_not_depend_on_how_its_photographs_came) {
  const ProjectSettings project = settings();
  for (const Vec2d middle : {Vec2d{0, 0}, Vec2d{512000, 5403200}}) {
    const std::vector<index::ImageRecord> all = photographs(60, middle);
    const Coverage at_once(all, project);
    ASSERT_GT(at_once.tiles(std::nullopt).size(), 20u);
    Coverage grown(project);
    Random random(6);
    std::set<int> there;
    for (int step = 0; step < 400; ++step) {
      const int i = random.below(60);
      if (there.insert(i).second) {
        grown.add(all[static_cast<std::size_t>(i)]);
      } else {
        there.erase(i);
        grown.remove(all[static_cast<std::size_t>(i)].name);
      }
    }
    for (int i = 0; i < 60; ++i)
      if (there.insert(i).second) grown.add(all[static_cast<std::size_t>(i)]);
    expect_same(at_once, grown);
  }
}

TEST(Coverage, a_photograph_changes_no_tile_but_those_it_touches) {
  const ProjectSettings project = settings();
  const std::vector<index::ImageRecord> all = photographs(60, {-30, 40});
  Coverage coverage(all, project);
  std::map<tiles::TileKey, std::string> before;
  for (const tiles::TileKey key : coverage.tiles(std::nullopt)) before[key] = coverage.candidates_digest(key, "s");
  for (const std::size_t i : {std::size_t{3}, std::size_t{30}, std::size_t{59}}) {
    const std::vector<tiles::TileKey> touched = coverage.touched(all[i]);
    coverage.remove(all[i].name);
    int changed = 0;
    for (const auto& [key, digest] : before) {
      if (coverage.candidates_digest(key, "s") == digest) continue;
      ++changed;
      EXPECT_NE(std::find(touched.begin(), touched.end(), key), touched.end()) << key.name();
    }
    EXPECT_GT(changed, 0);
    coverage.add(all[i]);
    for (const auto& [key, digest] : before) EXPECT_EQ(coverage.candidates_digest(key, "s"), digest);
  }
}

TEST(Coverage, digest_of_candidates_tells_names_bytes_poses_places_and_settings) {
  const ProjectSettings project = settings();
  const std::vector<index::ImageRecord> all = photographs(20, {0, 0});
  const tiles::TileKey key = Coverage(all, project).tiles(std::nullopt).front();
  const std::string name = Coverage(all, project).candidates(key).front()->name;
  const auto digest_when = [&](auto change) {
    std::vector<index::ImageRecord> changed = all;
    change(*std::find_if(changed.begin(), changed.end(), [&](const auto& image) { return image.name == name; }));
    return Coverage(changed, project).candidates_digest(key, "s");
  };
  const std::string digest = digest_when([](index::ImageRecord&) {});
  EXPECT_EQ(digest, Coverage(all, project).candidates_digest(key, "s"));
  EXPECT_NE(digest, digest_when([](index::ImageRecord& image) { image.name += "x"; }));
  EXPECT_NE(digest, digest_when([](index::ImageRecord& image) { image.content_digest += "x"; }));
  EXPECT_NE(digest, digest_when([](index::ImageRecord& image) { image.pose.center.z += 1e-6; }));
  EXPECT_NE(digest, digest_when([](index::ImageRecord& image) { image.model.distortion.k1 = 1e-9; }));
  EXPECT_NE(digest, digest_when([](index::ImageRecord& image) { image.status = index::ImageStatus::removed; }));
  EXPECT_EQ(digest, digest_when([](index::ImageRecord& image) { image.stamp = "touched"; }));
  EXPECT_EQ(digest, digest_when([](index::ImageRecord& image) { image.model.distortion.k3 = -0.0; }))
      << "a zero is a zero: databases do not keep its sign";
  EXPECT_NE(digest, Coverage(all, project).candidates_digest(key, "t"));
}

}  // namespace
}  // namespace skysweep::pipeline
