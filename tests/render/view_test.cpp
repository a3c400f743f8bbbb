// SPDX-License-Identifier: Apache-2.0
#include "render/view.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "render/look.h"

namespace skysweep::render {
namespace {

// Share of the way along a ray at which it passes the plane through `point` across the view direction, and where.
Vec3d on_plane(const Ray& ray, Vec3d point, Vec3d normal) {
  return along(ray, dot(point - ray.origin, normal) / dot(ray.direction, normal));
}

TEST(View, the_middle_of_the_picture_shows_the_target_and_up_is_up) {
  const Vec3d eye{1e7 + 10, 2e6, 80}, target{1e7 + 50, 2e6 + 30, 5};
  for (const View& view :
       {perspective_view(look_at(eye, target), 60, {200, 100}), parallel_view(eye, target, 60, {200, 100})}) {
    const Ray middle = *view.ray({100, 50});
    EXPECT_LT(norm(on_plane(middle, target, view.direction()) - target), 1e-6);
    const Vec3d above = on_plane(*view.ray({100, 10}), target, view.direction());
    const Vec3d right = on_plane(*view.ray({190, 50}), target, view.direction());
    EXPECT_GT(above.z, target.z + 1);
    EXPECT_NEAR(right.z, target.z, 1e-6);
    EXPECT_LT(cross(Vec2d{40, 30}, Vec2d{right.x - target.x, right.y - target.y}), 0);  // to the right of the way there
  }
}

TEST(View, a_parallel_view_shows_the_target_as_large_as_the_perspective_one) {
  const Vec3d eye{0, 0, 100}, target{0, 60, 20};
  const View perspective = perspective_view(look_at(eye, target), 40, {300, 200});
  const View parallel = parallel_view(eye, target, 40, {300, 200});
  const Vec3d a = on_plane(*perspective.ray({300, 100}), target, perspective.direction());
  const Vec3d b = on_plane(*parallel.ray({300, 100}), target, parallel.direction());
  EXPECT_LT(norm(a - b), 1e-9);
  EXPECT_NEAR(perspective.pixel().at(100), parallel.pixel().at(1), 1e-9);
}

TEST(View, plumb_views_have_north_at_the_top) {
  const View down = perspective_view(look_at({5, 6, 50}, {5, 6, 0}), 30, {100, 100});
  EXPECT_GT(down.ray({50, 0})->direction.y, 0);
  EXPECT_GT(down.ray({100, 50})->direction.x, 0);
  const Box3d box{{0, 0, 0}, {40, 30, 5}};
  const View top = named_view(NamedView::top, box, 45, false, {400, 300});
  EXPECT_GT(top.ray({200, 0})->origin.y, top.ray({200, 300})->origin.y);
}

// Corners of the box in pixels of a view.
std::vector<Vec2d> corners_in(const View& view, const Box3d& box, bool parallel) {
  // Through the rays of three pixels: the picture plane's axes at the origin of the middle ray.
  const PictureSize s = view.size();
  const Ray middle = *view.ray({s.width_px / 2., s.height_px / 2.});
  std::vector<Vec2d> all;
  const Vec3d right = view.right(), down = cross(view.direction(), right);
  for (int i = 0; i < 8; ++i) {
    const Vec3d corner{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
    const Vec3d d = corner - middle.origin;
    const double pixel = parallel ? view.pixel().fixed_m : view.pixel().per_metre * dot(d, view.direction());
    all.push_back({s.width_px / 2. + dot(d, right) / pixel, s.height_px / 2. + dot(d, down) / pixel});
  }
  return all;
}

TEST(View, named_views_hold_the_whole_map_and_fill_the_picture_in_one_direction) {
  const Box3d box{{1e6, 5e6, 400}, {1e6 + 120, 5e6 + 90, 431}};
  for (const PictureSize size : {PictureSize{1280, 720}, PictureSize{300, 500}})
    for (int v = 0; v < 4; ++v)
      for (const bool orthographic : {false, true}) {
        const auto named = static_cast<NamedView>(v);
        const View view = named_view(named, box, 45, orthographic, size);
        Box2d seen;
        for (const Vec2d corner : corners_in(view, box, orthographic || is_parallel(named))) seen.extend(corner);
        EXPECT_GE(seen.min.x, 0) << v;
        EXPECT_GE(seen.min.y, 0) << v;
        EXPECT_LE(seen.max.x, size.width_px) << v;
        EXPECT_LE(seen.max.y, size.height_px) << v;
        EXPECT_GT(std::max(seen.width() / size.width_px, seen.height() / size.height_px), 0.88) << v;
      }
}

TEST(View, a_photographs_view_has_its_rays_at_any_size) {
  camera::CameraModel model = camera::camera_from_sensor(12, 12, 800, 600);
  model.distortion.k1 = -0.05;
  const camera::Camera camera(model, look_at({3, 4, 90}, {10, 20, 0}));
  const View full = photograph_view(camera, {800, 600}), half = photograph_view(camera, {400, 300});
  for (const Vec2d pixel : {Vec2d{20, 30}, Vec2d{400, 300}, Vec2d{760, 590}}) {
    EXPECT_LT(norm(full.ray(pixel)->direction - *camera.ray(pixel)), 1e-15);
    EXPECT_LT(norm(half.ray(0.5 * pixel)->direction - *camera.ray(pixel)), 1e-9);
  }
  EXPECT_THROW(photograph_view(camera, {400, 400}), Error);
}

TEST(View, the_usual_sun_shines_from_the_north_west_on_maps_and_over_the_left_shoulder_elsewhere) {
  const Box3d box{{0, 0, 0}, {40, 30, 5}};
  const Sun map = usual_sun(named_view(NamedView::top, box, 45, false, {400, 300}));
  EXPECT_NEAR(map.azimuth_deg, 315, 1e-9);
  const Sun north = usual_sun(named_view(NamedView::north, box, 45, false, {400, 300}));
  EXPECT_NEAR(north.azimuth_deg, 225, 1e-9);
}

}  // namespace
}  // namespace skysweep::render
