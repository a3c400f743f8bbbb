// SPDX-License-Identifier: Apache-2.0
// What pictures show: looks, light, holes, and that threads change no byte.
#include "render/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>

#include "render/landscapes.h"
#include "render/legend.h"

namespace skysweep::render {
namespace {

// 64 x 48 cells of 0.5 m: level ground at 10 m, a block of 6 m in the middle, a hole, a gentle slope in the east.
MapWindow town() {
  MapWindow map;
  map.north_west_m = {5e6, 6e6};
  map.cell_m = 0.5;
  map.height_m = Array2d<float>(64, 48, 10.f);
  map.color = Array2d<Rgba8>(64, 48, {90, 140, 60, 255});
  map.sigma_m = Array2d<float>(64, 48, 0.05f);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      if (x >= 24 && x < 36 && y >= 16 && y < 30) {
        map.height_m(x, y) = 16;
        map.color(x, y) = {200, 80, 60, 255};
      }
      if (x >= 24) map.sigma_m(x, y) = 0.2f;
      if (x >= 50) map.height_m(x, y) = 10 + 0.5f * static_cast<float>(x - 50);
      if (x >= 6 && x < 12 && y >= 20 && y < 26) map.height_m(x, y) = std::nanf("");
    }
  return map;
}

// A cell's place on the ground.
Vec3d place_of(int x, int y) { return {5e6 + 0.5 * (x + 0.5), 6e6 - 0.5 * (y + 0.5), 10}; }

class Picture : public testing::Test {
 protected:
  explicit Picture(double exaggeration = 1) : scene(town(), exaggeration) {}

  Array2d<Rgb8> drawn(const View& view, const LookOptions& look, const PictureOptions& options = {},
                      Executor* executor = nullptr, SurfaceForm form = SurfaceForm::bilinear) const {
    SerialExecutor serial;
    Executor& used = executor ? *executor : serial;
    const ViewCounts counts(cameras, scene.true_bounds());
    const Shading shading(scene, look, view, &counts);
    const RayCaster caster(scene.field(), form);
    return draw_picture(view, shading, look, options, *make_cpu_tracer(caster, used), used, {});
  }

  // A pixel a cell: pixel (x, y) shows cell (x, y).
  View from_above() const {
    const camera::Pose pose = look_at({5e6 + 16, 6e6 - 12, 500}, {5e6 + 16, 6e6 - 12, 0});
    return {pose, 0.5, {64, 48}};
  }

  MapScene scene;
  std::vector<camera::Camera> cameras;
};

LookOptions of(Look look) {
  LookOptions options;
  options.look = look;
  return options;
}

TEST_F(Picture, an_orthophoto_from_above_is_the_map_itself) {
  const Array2d<Rgb8> picture = drawn(from_above(), of(Look::orthophoto));
  EXPECT_EQ(picture(4, 4), (Rgb8{90, 140, 60}));
  EXPECT_EQ(picture(30, 22), (Rgb8{200, 80, 60}));
}

TEST_F(Picture, holes_are_hatched_and_no_cliffs) {
  const LookOptions look = of(Look::orthophoto);
  const Array2d<Rgb8> picture = drawn(from_above(), look);
  std::set<int> greys;
  for (int y = 21; y < 25; ++y)
    for (int x = 7; x < 11; ++x) {
      EXPECT_LE(std::abs(picture(x, y).r - picture(x, y).g), 1) << x << " " << y;
      greys.insert(picture(x, y).r);
    }
  EXPECT_GT(greys.size(), 1u);
  // The stand-in surface is level here: a ray over the hole finds it at the height of the ground around.
  const RayCaster caster(scene.field(), SurfaceForm::boxes);
  EXPECT_DOUBLE_EQ(caster.first_hit({place_of(9, 23) + Vec3d{0, 0, 5}, {0, 0, -1}}).distance_m, 5);
}

TEST_F(Picture, slopes_face_the_sun_or_turn_from_it) {
  LookOptions east = of(Look::hillshade), west = east;
  east.sun = Sun{90, 30}, west.sun = Sun{270, 30};
  const Array2d<Rgb8> from_east = drawn(from_above(), east), from_west = drawn(from_above(), west);
  // The slope in the east rises eastwards: it faces west.
  EXPECT_GT(from_west(57, 10).r, from_east(57, 10).r + 20);
  EXPECT_EQ(from_west(4, 4), from_east(4, 4));
}

TEST_F(Picture, a_block_casts_a_shadow_as_long_as_the_sun_says) {
  LookOptions look = of(Look::hillshade);
  look.sun = Sun{90, 45};
  const Array2d<Rgb8> lit = drawn(from_above(), look);
  look.shadows = true;
  const Array2d<Rgb8> shaded = drawn(from_above(), look);
  // Westwards of the block, 6 m high: 6 m are 12 cells.
  EXPECT_LT(shaded(14, 22).r, lit(14, 22).r - 50);
  EXPECT_LT(shaded(20, 22).r, lit(20, 22).r - 50);
  EXPECT_EQ(shaded(5, 16), lit(5, 16));
  EXPECT_EQ(shaded(40, 22), lit(40, 22));
  EXPECT_EQ(shaded(30, 22), lit(30, 22));
  EXPECT_EQ(shaded(4, 4), lit(4, 4));
}

TEST_F(Picture, numbers_have_the_colours_of_the_legend) {
  const Array2d<Rgb8> relief = drawn(from_above(), of(Look::relief)), sigma = drawn(from_above(), of(Look::confidence)),
                      slope = drawn(from_above(), of(Look::slope));
  EXPECT_FALSE(relief(4, 4) == relief(30, 22));
  EXPECT_FALSE(sigma(4, 4) == sigma(30, 22));
  EXPECT_GT(sigma(30, 22).r, sigma(30, 22).g);  // uncertain: towards red
  EXPECT_GT(sigma(4, 4).g, sigma(4, 4).r);
  EXPECT_FALSE(slope(4, 4) == slope(57, 10));
  LookOptions stretched = of(Look::relief);
  stretched.relief_span_m = raster::HeightSpan{0, 100};
  EXPECT_FALSE(drawn(from_above(), stretched)(30, 22) == relief(30, 22));
}

TEST_F(Picture, views_are_counted_where_photographs_look) {
  const Array2d<Rgb8> none = drawn(from_above(), of(Look::views));
  cameras.emplace_back(camera::camera_from_sensor(20, 12, 300, 200),
                       look_at({5e6 + 4, 6e6 - 4, 40}, {5e6 + 4, 6e6 - 4, 0}));
  const Array2d<Rgb8> one = drawn(from_above(), of(Look::views));
  EXPECT_FALSE(one(8, 8) == one(60, 44));
}

TEST_F(Picture, levels_show_where_detail_was_left_away) {
  const View far = named_view(NamedView::overview, scene.drawn_bounds(), 45, false, {24, 16});
  PictureOptions exact, coarse;
  exact.samples = coarse.samples = 1;
  exact.level_of_detail = false;
  const Array2d<Rgb8> a = drawn(far, of(Look::level), exact), b = drawn(far, of(Look::level), coarse);
  EXPECT_FALSE(a == b);
}

double mean_difference(const Array2d<Rgb8>& a, const Array2d<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb8 p = a.data()[i], q = b.data()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
  }
  return sum / (3.0 * static_cast<double>(a.size()));
}

// A slow flight away from the map, over which whole levels of detail are left out one after the other: no frame jumps.
// Bounds: the picture stays within half a grey level (mean) of the one without the stop, and changes from frame to
// frame no more than a tenth of one beyond what that one does.
TEST_F(Picture, levels_of_detail_come_and_go_without_popping) {
  PictureOptions exact;
  exact.level_of_detail = false;
  LookOptions look = of(Look::relief);
  look.relief_span_m = raster::HeightSpan{9, 17};
  std::optional<Array2d<Rgb8>> before, exact_before;
  for (double distance = 60; distance < 1500; distance *= 1.03) {
    const Vec3d target = place_of(32, 24), eye = target + distance * normalized(Vec3d{-0.3, -1, 0.7});
    const View view = perspective_view(look_at(eye, target), 8, {64, 48});
    const Array2d<Rgb8> frame = drawn(view, look), exact_frame = drawn(view, look, exact);
    EXPECT_LT(mean_difference(frame, exact_frame), 0.5) << distance;
    if (before) {
      EXPECT_LT(mean_difference(frame, *before), mean_difference(exact_frame, *exact_before) + 0.1) << distance;
    }
    before = frame;
    exact_before = exact_frame;
  }
}

TEST_F(Picture, samples_smooth_edges) {
  PictureOptions one, three;
  one.samples = 1, three.samples = 3;
  const View view = named_view(NamedView::overview, scene.drawn_bounds(), 45, false, {120, 80});
  const auto colors = [](const Array2d<Rgb8>& picture) {
    std::set<int> all;
    for (const Rgb8 c : picture) all.insert(c.r << 16 | c.g << 8 | c.b);
    return all.size();
  };
  EXPECT_GT(colors(drawn(view, of(Look::orthophoto), three)), colors(drawn(view, of(Look::orthophoto), one)));
}

TEST_F(Picture, threads_change_no_byte) {
  ThreadExecutor three(3);
  LookOptions look = of(Look::relief);
  look.shadows = true;
  const View view = named_view(NamedView::overview, scene.drawn_bounds(), 45, false, {160, 90});
  EXPECT_EQ(drawn(view, look), drawn(view, look, {}, &three));
}

TEST_F(Picture, the_background_is_where_there_is_no_map) {
  LookOptions look = of(Look::hillshade);
  look.background = {1, 2, 3};
  const Array2d<Rgb8> picture =
      drawn(perspective_view(look_at({5e6, 6e6 - 40, 30}, {5e6 + 10, 6e6, 30}), 60, {60, 40}), look);
  EXPECT_EQ(picture(30, 2), (Rgb8{1, 2, 3}));
}

TEST_F(Picture, the_map_moved_far_away_looks_the_same) {
  MapWindow moved = town();
  moved.north_west_m = moved.north_west_m + Vec2d{1 << 20, -(1 << 21)};
  const MapScene there(moved, 1);
  const Vec3d shift{1 << 20, -(1 << 21), 0};
  const auto at = [&](const MapScene& s, Vec3d by) {
    SerialExecutor serial;
    const View view =
        perspective_view(look_at(place_of(30, 70) + by + Vec3d{0, 0, 20}, place_of(30, 22) + by), 50, {90, 60});
    const Shading shading(s, of(Look::relief), view, nullptr);
    const RayCaster caster(s.field(), SurfaceForm::bilinear);
    return draw_picture(view, shading, of(Look::relief), {}, *make_cpu_tracer(caster, serial), serial, {});
  };
  EXPECT_EQ(at(scene, {}), at(there, shift));
}

class ExaggeratedPicture : public Picture {
 protected:
  ExaggeratedPicture() : Picture(3) {}
};

TEST_F(ExaggeratedPicture, heights_grow_in_the_picture_and_not_in_the_numbers) {
  const RayCaster caster(scene.field(), SurfaceForm::boxes);
  const Hit roof = caster.first_hit({place_of(30, 22) + Vec3d{0, 0, 90}, {0, 0, -1}});
  EXPECT_NEAR(100 - roof.distance_m, 28, 1e-5);
  EXPECT_NEAR(scene.true_height_m({place_of(30, 22).x, place_of(30, 22).y, 28}), 16, 1e-5);
  EXPECT_NEAR(scene.true_normal(place_of(57, 10), 0).z, 1 / std::sqrt(2.0),
              1e-3);  // half a metre a cell of half a metre
}

TEST_F(Picture, layers_hold_distance_place_normal_and_level) {
  SerialExecutor serial;
  const LookOptions look;
  const View view = from_above();
  const Shading shading(scene, look, view, nullptr);
  const RayCaster caster(scene.field(), SurfaceForm::bilinear);
  const Vec3d origin{5e6, 6e6, 0};
  const PictureLayers layers = draw_layers(view, shading, origin, *make_cpu_tracer(caster, serial), serial);
  EXPECT_FLOAT_EQ(layers.distance_m(4, 4), 490);
  EXPECT_FLOAT_EQ(layers.x_m(4, 4), 2.25);
  EXPECT_FLOAT_EQ(layers.y_m(4, 4), -2.25);
  EXPECT_FLOAT_EQ(layers.z_m(30, 22), 16);
  EXPECT_FLOAT_EQ(layers.normal_z(4, 4), 1);
  EXPECT_LT(layers.normal_x(57, 10), -0.5);
}

TEST(Legend, is_drawn_into_the_corner_and_left_out_of_small_pictures) {
  Array2d<Rgb8> large(400, 300), small(100, 80);
  const Scale scale{&relief_palette(), 12, 34, "height, m"};
  draw_legend(scale, large);
  draw_legend(scale, small);
  EXPECT_FALSE(large(20, 280) == Rgb8{});
  EXPECT_EQ(large(390, 10), Rgb8{});
  EXPECT_EQ(small, Array2d<Rgb8>(100, 80));
}

}  // namespace
}  // namespace skysweep::render
