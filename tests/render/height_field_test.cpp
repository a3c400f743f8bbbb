// SPDX-License-Identifier: Apache-2.0
#include "render/height_field.h"

#include <gtest/gtest.h>

#include "render/height_hierarchy.h"
#include "render/landscapes.h"

namespace skysweep::render {
namespace {

TEST(HeightField, what_is_enclosed_is_a_hole_and_what_reaches_the_border_is_outside) {
  const auto field = hard_landscape({100, 200});
  EXPECT_EQ(field->kind(15, 22), CellKind::hole);
  EXPECT_EQ(field->kind(30, 5), CellKind::hole);
  EXPECT_EQ(field->kind(25, 33), CellKind::outside);
  EXPECT_EQ(field->kind(24, 28), CellKind::outside);
  EXPECT_EQ(field->kind(0, 0), CellKind::known);
  EXPECT_TRUE(std::isnan(field->height_m(25, 30)));
}

TEST(HeightField, a_stand_in_lies_between_the_heights_around_it) {
  Array2d<float> height(7, 7, 2.f);
  for (int y = 0; y < 7; ++y)
    for (int x = 4; x < 7; ++x) height(x, y) = 4;
  for (int y = 2; y < 5; ++y)
    for (int x = 2; x < 5; ++x) height(x, y) = kNothing;
  const HeightField field = make_height_field({}, 1, height);
  for (int y = 2; y < 5; ++y)
    for (int x = 2; x < 5; ++x) {
      EXPECT_GE(field.height_m(x, y), 2) << x << " " << y;
      EXPECT_LE(field.height_m(x, y), 4) << x << " " << y;
    }
  EXPECT_LT(field.height_m(2, 3), field.height_m(4, 3));
}

TEST(HeightField, bounds_leave_spikes_out_and_follow_the_known_cells) {
  const auto field = hard_landscape({100, 200});
  const Box3d all = bounds(*field, 0), usual = bounds(*field, 0.01);
  EXPECT_EQ(all.min.x, 100);
  EXPECT_EQ(all.max.y, 200);
  EXPECT_EQ(all.max.x, 119.5);
  EXPECT_GT(all.max.z, 7);
  EXPECT_LE(usual.max.z, 5.01);
}

TEST(HeightField, exaggeration_multiplies_heights_above_the_base) {
  const HeightField field = exaggerated(*hard_landscape({0, 0}), 3, 1);
  EXPECT_FLOAT_EQ(field.height_m(22, 10), 13);
}

TEST(HeightHierarchy, ranges_hold_all_elements_below_and_the_last_level_is_one_square) {
  const auto field = hard_landscape({0, 0});
  for (const SurfaceForm form : {SurfaceForm::boxes, SurfaceForm::bilinear}) {
    const HeightHierarchy hierarchy(*field, form);
    EXPECT_EQ(hierarchy.level(hierarchy.levels() - 1).size(), 1u);
    for (int level = 1; level < hierarchy.levels(); ++level)
      for (int y = 0; y < hierarchy.level(0).height(); ++y)
        for (int x = 0; x < hierarchy.level(0).width(); ++x) {
          const HeightRange element = hierarchy.level(0)(x, y), square = hierarchy.level(level)(x >> level, y >> level);
          if (element.empty()) continue;
          ASSERT_LE(square.min, element.min);
          ASSERT_GE(square.max, element.max);
        }
  }
}

}  // namespace
}  // namespace skysweep::render
