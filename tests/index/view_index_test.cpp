// SPDX-License-Identifier: Apache-2.0
#include "index/view_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/random.h"

namespace skysweep::index {
namespace {

struct Entry {
  Box3d box;
  bool near_vertical;
};
// The same things by looking at every box.
using BruteForce = std::map<int, Entry>;

bool intersect(const Box3d& a, const Box3d& b) {
  return a.ground().intersects(b.ground()) && a.min.z <= b.max.z && b.min.z <= a.max.z;
}

std::vector<int> query(const BruteForce& entries, const Box3d& box) {
  std::vector<int> ids;
  for (const auto& [id, entry] : entries)
    if (intersect(entry.box, box)) ids.push_back(id);
  return ids;
}

Box3d extent(const BruteForce& entries) {
  Box3d extent;
  for (const auto& [id, entry] : entries) extent.extend(entry.box.min), extent.extend(entry.box.max);
  return extent;
}

Box2d mapped_area(const BruteForce& entries) {
  Box2d area;
  for (const auto& [id, entry] : entries)
    if (entry.near_vertical) area.extend(entry.box.ground().min), area.extend(entry.box.ground().max);
  return area;
}

Box3d random_box(Random& random, Vec3d origin, double largest) {
  const Vec3d corner = origin + Vec3d{random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-50, 50)};
  const Vec3d size{random.uniform(0, largest), random.uniform(0, largest), random.uniform(0, largest)};
  return {corner, corner + size};
}

class ViewIndexAnywhere : public testing::TestWithParam<std::pair<double, double>> {
 protected:
  Vec3d origin() const { return {GetParam().first, GetParam().second, 0}; }
};

TEST_P(ViewIndexAnywhere, answers_as_a_look_at_every_box_does_while_boxes_come_and_go) {
  Random random(31);
  ViewIndex index;
  BruteForce expected;
  for (int step = 0; step < 3000; ++step) {
    // Grows to some hundreds of boxes, then shrinks to nothing.
    const bool grow = expected.empty() || random.uniform() < (step < 1500 ? 0.75 : 0.2);
    if (grow) {
      const Entry entry{random_box(random, origin(), 150), random.below(3) > 0};
      index.insert(step, entry.box, entry.near_vertical);
      expected[step] = entry;
    } else {
      const auto victim = std::next(expected.begin(), random.below(static_cast<int>(expected.size())));
      index.remove(victim->first);
      expected.erase(victim);
    }
    ASSERT_EQ(index.size(), static_cast<int>(expected.size()));
    ASSERT_EQ(index.extent(), extent(expected)) << "step " << step;
    ASSERT_EQ(index.mapped_area(), mapped_area(expected)) << "step " << step;
    const Box3d box = random_box(random, origin(), 80);
    ASSERT_EQ(index.query(box), query(expected, box)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Origins, ViewIndexAnywhere,
                         testing::Values(std::pair{0.0, 0.0}, std::pair{412'345.25, 5'654'321.5},
                                         std::pair{-3e5, -1e7}));

TEST(ViewIndex, boxes_that_only_touch_meet) {
  ViewIndex index;
  index.insert(4, {{0, 0, 0}, {1, 1, 1}}, true);
  EXPECT_EQ(index.query({{1, 1, 1}, {2, 2, 2}}), std::vector<int>{4});
  EXPECT_TRUE(index.query({{std::nextafter(1.0, 2.0), 0, 0}, {2, 1, 1}}).empty());
}

TEST(ViewIndex, may_be_asked_about_any_height) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ViewIndex index;
  index.insert(1, {{0, 0, 900}, {10, 10, 1000}}, true);
  EXPECT_EQ(index.query({{5, 5, -kInfinity}, {6, 6, kInfinity}}), std::vector<int>{1});
}

TEST(ViewIndex, empty_has_an_empty_extent_and_answers_nothing) {
  const ViewIndex index;
  EXPECT_TRUE(index.extent().empty());
  EXPECT_TRUE(index.mapped_area().empty());
  EXPECT_TRUE(index.query({{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}}).empty());
}

TEST(ViewIndex, oblique_photographs_do_not_widen_the_mapped_area) {
  ViewIndex index;
  index.insert(1, {{0, 0, 0}, {10, 10, 100}}, true);
  index.insert(2, {{0, 0, 0}, {500, 500, 100}}, false);
  EXPECT_EQ(index.mapped_area(), (Box2d{{0, 0}, {10, 10}}));
  EXPECT_EQ(index.extent(), (Box3d{{0, 0, 0}, {500, 500, 100}}));
}

TEST(ViewIndexDeathTest, the_same_id_twice_or_an_unknown_one_is_a_bug) {
  ViewIndex index;
  index.insert(1, {{0, 0, 0}, {1, 1, 1}}, true);
  EXPECT_DEATH(index.insert(1, {{0, 0, 0}, {1, 1, 1}}, true), "is_new");
  EXPECT_DEATH(index.remove(2), "entries");
}

}  // namespace
}  // namespace skysweep::index
