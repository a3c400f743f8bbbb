// SPDX-License-Identifier: Apache-2.0
#include "report/class_accuracy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "height_cells.h"

namespace skysweep::report {
namespace {

TEST(ClassAccuracy, every_cell_counts_in_its_class) {
  // Four columns: class 0, 1, 2, 2; the third is 1 m too high, the fourth has no height, the first no truth in one row.
  const auto truth = [](Vec2d p) { return p.x < 1 && p.y < 1 ? kHole : 10.0f; };
  const auto measured = [](Vec2d p) { return p.x < 2 ? 10.0f : p.x < 3 ? 11.0f : kHole; };
  const HeightDifferences cells = make_cells(4, 5, 1, truth, measured);
  ClassMap classes{Array2d<std::uint8_t>(4, 5), {"", "ground"}};
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 4; ++column)
      classes.codes(column, row) = static_cast<std::uint8_t>(std::min(column, 2));
  const std::vector<ClassErrors> c = accuracy_by_class(cells, classes, 0.5);
  ASSERT_EQ(c.size(), 3u);
  EXPECT_EQ(c[0].name, "none");
  EXPECT_EQ(c[0].errors.reference_count, 4);
  EXPECT_EQ(c[1].name, "ground");
  EXPECT_EQ(c[1].errors.rmse_m, 0);
  EXPECT_EQ(c[2].name, "class 2");
  EXPECT_EQ(c[2].errors.reference_count, 10);
  EXPECT_EQ(c[2].errors.valid_count, 5);
  EXPECT_EQ(c[2].errors.median_m, 1);
  EXPECT_EQ(c[2].errors.within_of_all[1], 0.5);  // two GSD
}

TEST(ClassAccuracy, the_region_of_buildings_reaches_as_far_as_its_margin) {
  ClassMap classes{Array2d<std::uint8_t>(21, 21), {"none", "ground", "roof", "facade edge", "tree"}};
  classes.codes(10, 10) = 2;
  classes.codes(0, 0) = 4;
  const Array2d<std::uint8_t> region = building_region(classes, 0.5, 0.1);  // five cells
  EXPECT_EQ(region(15, 10), 1);
  EXPECT_EQ(region(13, 14), 1);  // 3, 4, 5
  EXPECT_EQ(region(16, 10), 0);
  EXPECT_EQ(region(14, 14), 0);
  EXPECT_EQ(region(0, 0), 0);
}

TEST(ClassAccuracy, without_names_or_buildings_there_is_no_region) {
  ClassMap classes{Array2d<std::uint8_t>(3, 3, 2), {}};
  EXPECT_TRUE(building_region(classes, 1, 1).empty());
  classes.names = {"none", "roof", "ground"};
  EXPECT_TRUE(building_region(classes, 1, 1).empty());  // a roof by name, but nowhere
  classes.names[2] = "facade edge";
  EXPECT_FALSE(building_region(classes, 1, 1).empty());
}

}  // namespace
}  // namespace skysweep::report
