// SPDX-License-Identifier: Apache-2.0
// The reference ray caster against what can be worked out by hand.
#include "render/ray_caster.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "render/landscapes.h"

namespace skysweep::render {
namespace {

std::shared_ptr<const HeightField> field_of(Array2d<float> height, double cell_m = 1) {
  return std::make_shared<HeightField>(make_height_field({0, cell_m * height.height()}, cell_m, std::move(height)));
}

Ray towards(Vec3d from, Vec3d to) { return {from, normalized(to - from)}; }

TEST(RayCaster, a_plumb_ray_finds_the_height_of_its_cell) {
  const auto field = hard_landscape({1e7, -3e6});
  const RayCaster boxes(field, SurfaceForm::boxes);
  for (int y = 0; y < field->height_m.height(); ++y)
    for (int x = 0; x < field->height_m.width(); ++x) {
      const Vec3d above = field->map_from_cells({x + 0.3, y + 0.6, 50});
      const Hit hit = boxes.first_hit({above, {0, 0, -1}});
      ASSERT_EQ(hit.any(), field->kind(x, y) != CellKind::outside) << x << " " << y;
      if (!hit.any()) continue;
      ASSERT_NEAR(50 - hit.distance_m, field->height_m(x, y), 1e-9) << x << " " << y;
    }
}

TEST(RayCaster, a_level_ray_meets_the_wall_of_a_step) {
  Array2d<float> height(8, 4, 0.f);
  for (int y = 0; y < 4; ++y)
    for (int x = 5; x < 8; ++x) height(x, y) = 3;
  const RayCaster boxes(field_of(height), SurfaceForm::boxes);
  const Hit wall = boxes.first_hit({{-10, 1.5, 2}, {1, 0, 0}});
  EXPECT_DOUBLE_EQ(wall.distance_m, 15);
  EXPECT_EQ(wall.face, Face::wall_x);
  EXPECT_FALSE(wall.from_below);
  EXPECT_FALSE(boxes.first_hit({{-10, 1.5, 3.5}, {1, 0, 0}}).any());
}

TEST(RayCaster, the_edge_of_the_map_is_no_wall) {
  const RayCaster boxes(field_of(Array2d<float>(8, 4, 5.f)), SurfaceForm::boxes);
  EXPECT_FALSE(boxes.first_hit({{-10, 1.5, 2}, {1, 0, 0}}).any());
  EXPECT_TRUE(boxes.first_hit(towards({-10, 1.5, 2}, {4, 1.5, 5.2})).from_below);
}

TEST(RayCaster, a_camera_under_ground_sees_the_surface_from_below) {
  for (const SurfaceForm form : {SurfaceForm::boxes, SurfaceForm::bilinear}) {
    const RayCaster caster(field_of(Array2d<float>(8, 8, 5.f)), form);
    const Hit hit = caster.first_hit({{4.2, 4.3, 1}, {0, 0, 1}});
    EXPECT_DOUBLE_EQ(hit.distance_m, 4);
    EXPECT_TRUE(hit.from_below);
  }
}

TEST(RayCaster, a_patch_is_met_where_its_formula_says) {
  Array2d<float> height(2, 2);
  height(0, 0) = 1, height(1, 0) = 3, height(0, 1) = 2, height(1, 1) = 0;
  const RayCaster caster(field_of(height), SurfaceForm::bilinear);
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(0.02, 0.98), y = random.uniform(0.02, 0.98);  // y southwards
    const double z = (1 - y) * (1 + 2 * x) + y * (2 - 2 * x);
    const Vec3d place{0.5 + x, 1.5 - y, z};
    // From above and steeper than the patch, so that this is the first place.
    const Vec3d from = place + Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), 12};
    const Hit hit = caster.first_hit(towards(from, place));
    ASSERT_TRUE(hit.any());
    ASSERT_NEAR(hit.distance_m, norm(place - from), 1e-9);
  }
}

TEST(RayCaster, a_ray_may_cross_a_patch_twice_and_stops_at_the_first_place) {
  Array2d<float> saddle(2, 2);
  saddle(0, 0) = saddle(1, 1) = 1, saddle(1, 0) = saddle(0, 1) = -1;
  const RayCaster caster(field_of(saddle), SurfaceForm::bilinear);
  // Along the diagonal from corner to corner of the square of centres the height is 1 - 4 q + 4 q^2; z = 0.25 is met at
  // q = 1/4 and 3/4.
  const Hit hit = caster.first_hit(towards({1.5, 0.5, 0.25}, {0.5, 1.5, 0.25}));
  ASSERT_TRUE(hit.any());
  EXPECT_NEAR(hit.distance_m, 0.25 * std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(hit.from_below);
}

TEST(RayCaster, the_hierarchy_changes_no_hit_and_saves_steps) {
  const auto field = hard_landscape({3, 4});
  Random random(11);
  for (const SurfaceForm form : {SurfaceForm::boxes, SurfaceForm::bilinear}) {
    const RayCaster caster(field, form);
    std::int64_t with = 0, without = 0;
    for (int i = 0; i < 4000; ++i) {
      const Ray ray =
          towards(field->map_from_cells({random.uniform(-40, 80), random.uniform(-40, 80), random.uniform(-4, 12)}),
                  field->map_from_cells({random.uniform(0, 39), random.uniform(0, 34), random.uniform(-2, 6)}));
      TraceOptions plain;
      plain.use_hierarchy = false;
      const Hit a = caster.first_hit(ray, {}, &with), b = caster.first_hit(ray, plain, &without);
      ASSERT_EQ(a.distance_m, b.distance_m) << i;
      ASSERT_EQ(a.face, b.face) << i;
      ASSERT_EQ(a.from_below, b.from_below) << i;
    }
    EXPECT_LT(with, without);
  }
}

// From above, every ray that ends below the lowest height within a map without notches has to hit something: rays
// through corners and along the borders of cells, where rounding would open cracks, included.
TEST(RayCaster, there_are_no_cracks) {
  Array2d<float> height(33, 29);
  Random random(3);
  for (float& h : height) h = static_cast<float>(random.uniform(0, 3));
  const auto field = std::make_shared<HeightField>(make_height_field({1e7, 1e7}, 0.1, height));
  for (const SurfaceForm form : {SurfaceForm::boxes, SurfaceForm::bilinear}) {
    const RayCaster caster(field, form);
    int missed = 0;
    for (int i = 0; i < 60000; ++i) {
      const bool corners = i % 2 == 0;
      const auto place = [&](double low, double high) {
        const double v = random.uniform(low, high);
        return corners ? std::round(2 * v) / 2 : v;
      };
      const Vec3d from = field->map_from_cells({place(1, 32), place(1, 28), 4});
      const Vec3d to = field->map_from_cells({place(1, 32), place(1, 28), -0.5});
      missed += !caster.first_hit(towards(from, to)).any();
    }
    EXPECT_EQ(missed, 0);
  }
}

TEST(RayCaster, with_the_level_of_detail_stop_hits_lie_within_a_pixel_of_the_surface) {
  const auto field = hard_landscape({0, 0});
  const RayCaster caster(field, SurfaceForm::bilinear);
  Random random(17);
  TraceOptions coarse;
  coarse.pixel.per_metre = 0.05;
  int stopped = 0;
  std::int64_t with = 0, without = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray =
        towards(field->map_from_cells({random.uniform(-150, 190), random.uniform(-150, 190), random.uniform(10, 60)}),
                field->map_from_cells({random.uniform(0, 39), random.uniform(0, 34), 0}));
    const Hit hit = caster.first_hit(ray, coarse, &with);
    caster.first_hit(ray, {}, &without);
    if (hit.face != Face::square) continue;
    ++stopped;
    // Some of the surface lies in the square's box, which is smaller than the pixel.
    const Vec3d p = field->cells_from_map(along(ray, hit.distance_m));
    double nearest = 1e9;
    for (int y = 0; y < 34; ++y)
      for (int x = 0; x < 39; ++x) {
        if (field->kind(x, y) == CellKind::outside) continue;
        const Vec3d d{0.5 * (x + 0.5 - p.x), 0.5 * (y + 0.5 - p.y), field->height_m(x, y) - p.z};
        nearest = std::min(nearest, norm(d));
      }
    ASSERT_LT(nearest, coarse.pixel.at(hit.distance_m)) << i;
  }
  EXPECT_GT(stopped, 1000);
  EXPECT_LT(with, without);
}

}  // namespace
}  // namespace skysweep::render
