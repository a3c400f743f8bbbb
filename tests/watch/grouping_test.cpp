// SPDX-License-Identifier: Apache-2.0
#include "watch/grouping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.h"
#include "watch/quarantine.h"

namespace skysweep::watch {
namespace {

Grouping::Photograph taken(const std::string& name, double minutes) { return {name, 60 * minutes, {}}; }
Grouping::Photograph at(const std::string& name, double x, double y = 0) { return {name, std::nullopt, {x, y, 100}}; }

TEST(Grouping, without_a_rule_all_are_one_map) {
  Grouping grouping(GroupRule::none, 1);
  EXPECT_EQ(grouping.place({"a/1.jpg", {}, {}}), "map");
  EXPECT_EQ(grouping.place({"2.jpg", {}, {1e6, 0, 0}}), "map");
}

TEST(Grouping, by_folder) {
  Grouping grouping(GroupRule::folder, 1);
  EXPECT_EQ(grouping.place({"1.jpg", {}, {}}), "map");
  EXPECT_EQ(grouping.place({"flight1/1.jpg", {}, {}}), "flight1");
  EXPECT_EQ(grouping.place({"flight1/2.jpg", {}, {}}), "flight1");
  EXPECT_NE(grouping.place({"flight1/DCIM/2.jpg", {}, {}}), "flight1");
  EXPECT_NE(grouping.place({"map/2.jpg", {}, {}}), "map") << "beside the photographs that lie in no folder";
}

TEST(Grouping, by_time_a_flight_ends_with_the_gap) {
  Grouping grouping(GroupRule::time, 10);
  EXPECT_EQ(grouping.place(taken("a", 0)), "1970-01-01T000000");
  EXPECT_EQ(grouping.place(taken("b", 10)), "1970-01-01T000000");
  EXPECT_EQ(grouping.place(taken("c", 21)), "1970-01-01T002100");
  EXPECT_EQ(grouping.place({"no time", std::nullopt, {}}), std::nullopt);
}

TEST(Grouping, by_distance_on_the_ground) {
  Grouping grouping(GroupRule::distance, 100);
  EXPECT_EQ(grouping.place(at("a", 691200.4, 5334000)), "x691200y5334000");
  EXPECT_EQ(grouping.place(at("b", 691300.3, 5334000)), "x691200y5334000");
  EXPECT_EQ(grouping.place(at("c", 691500, 5334000)), "x691500y5334000");
  EXPECT_EQ(grouping.place(at("d", -250, -250)), "x-250y-250");
}

TEST(Grouping, a_photograph_between_two_groups_makes_them_the_older_one) {
  Grouping grouping(GroupRule::distance, 100);
  EXPECT_EQ(grouping.place(at("a", 1000)), "x1000y0");
  EXPECT_EQ(grouping.place(at("b", 850)), "x850y0");
  EXPECT_EQ(grouping.place(at("c", 925)), "x1000y0");
  EXPECT_EQ(grouping.group_of("b"), "x1000y0");
}

TEST(Grouping, who_belongs_together_does_not_depend_on_the_order) {
  std::vector<Grouping::Photograph> photographs;
  for (int i = 0; i < 60; ++i) photographs.push_back(at("p" + std::to_string(i), 40.0 * i + (i / 20) * 500));
  Random random(7);
  for (int trial = 0; trial < 5; ++trial) {
    for (std::size_t i = photographs.size(); i > 1; --i)
      std::swap(photographs[i - 1], photographs[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    Grouping grouping(GroupRule::distance, 50);
    for (const auto& photograph : photographs) grouping.place(photograph);
    std::set<std::string> names;
    for (int i = 0; i < 60; ++i) {
      EXPECT_EQ(grouping.group_of("p" + std::to_string(i)), grouping.group_of("p" + std::to_string(i / 20 * 20)));
      names.insert(grouping.group_of("p" + std::to_string(i)));
    }
    EXPECT_EQ(names.size(), 3u);
  }
}

TEST(Grouping, what_was_written_down_is_kept_by_the_next_watcher) {
  Grouping before(GroupRule::distance, 100);
  before.place(at("odd \"name\",\nhere", 0));
  before.place(at("b", 500));
  Grouping after(GroupRule::distance, 100);
  after.restore(before.text());
  EXPECT_EQ(after.text(), before.text());
  EXPECT_EQ(after.place(at("odd \"name\",\nhere", 20)), "x0y0") << "not x20y0";
  EXPECT_EQ(after.place(at("c", 60)), "x0y0");
  after.restore("photograph,group\nevil,../../etc\n");
  EXPECT_FALSE(after.knows("evil"));
}

TEST(Grouping, another_rule_holds_for_those_that_come) {
  Grouping grouping(GroupRule::distance, 100);
  grouping.place(at("a", 0));
  grouping.use(GroupRule::distance, 400);
  EXPECT_EQ(grouping.place(at("b", 300)), "x0y0");
  grouping.use(GroupRule::none, 400);
  EXPECT_EQ(grouping.place(at("c", 5000)), "map");
  EXPECT_EQ(grouping.place(at("a", 0)), "x0y0");
}

TEST(Grouping, many_photographs_cost_no_more_each) {
  // Ten thousand along a line of which every hundredth begins another group: quadratic work would take minutes.
  Grouping grouping(GroupRule::distance, 10);
  for (int i = 0; i < 10000; ++i) grouping.place(at("p" + std::to_string(i), 9.0 * i + 20.0 * (i / 100)));
  EXPECT_NE(grouping.group_of("p99"), grouping.group_of("p100"));
  EXPECT_EQ(grouping.group_of("p9999"), grouping.group_of("p9900"));
}

TEST(SafeName, is_a_folder_in_the_root_and_different_for_different_names) {
  EXPECT_EQ(safe_name("flight-1_a.b"), "flight-1_a.b");
  EXPECT_EQ(safe_name("Überflug"), "Überflug");
  std::set<std::string> names;
  const std::vector<std::string> odd = {"..",
                                        ".",
                                        ".hidden",
                                        "a/b",
                                        "a b",
                                        "a\nb",
                                        "a\"b",
                                        "",
                                        "status.json",
                                        "groups.csv",
                                        std::string(300, 'x'),
                                        std::string(301, 'x')};
  for (const std::string& name : odd) {
    const std::string safe = safe_name(name);
    EXPECT_EQ(safe.find_first_of("/ \n\""), std::string::npos) << safe;
    EXPECT_FALSE(safe.starts_with(".")) << safe;
    EXPECT_LE(safe.size(), 100u);
    EXPECT_EQ(safe_name(safe), safe);
    names.insert(safe);
  }
  EXPECT_EQ(names.size(), odd.size());
}

TEST(Quarantine, holds_any_name_and_reason) {
  const std::string text = quarantine_text({{"a \"b\",\n.jpg", "is, \"broken\""}, {"c.jpg", "too"}});
  const std::vector<std::vector<std::string>> rows = {
      {"file", "reason"}, {"a \"b\",\n.jpg", "is, \"broken\""}, {"c.jpg", "too"}};
  EXPECT_EQ(csv_rows(text), rows);
}

}  // namespace
}  // namespace skysweep::watch
