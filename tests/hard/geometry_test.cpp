// SPDX-License-Identifier: Apache-2.0
// Hard cases of viewing geometry: how few and how many views, baselines, angles and places of the camera.
#include "hard/box_world.h"
#include "hard/sound_result.h"
#include "index/view_selection.h"
#include "sweep/backend.h"

namespace skysweep::hard {
namespace {

const camera::CameraModel kCamera = test::small_camera();  // 320 x 240, f 300 px: GSD 0.1 m from 30 m

// Cost of the best plane and the plane itself, cell by cell, from the fast backend against the one in double precision
// that projects every cell by itself. Costs agree to `grey_levels`.
void expect_backends_agree(sweep::SweepProblem problem, double grey_levels) {
  problem.options.smoothing = sweep::Smoothing::none;
  SerialExecutor serial;
  const auto cpu = sweep::match_planes(problem, sweep::Backend::cpu, serial);
  const auto reference = sweep::match_planes(problem, sweep::Backend::reference, serial);
  int known = 0, different = 0;
  double worst = 0;
  for (std::size_t i = 0; i < cpu.cost.size(); ++i) {
    const double a = cpu.cost.data()[i], b = reference.cost.data()[i];
    known += std::isfinite(b);
    if (std::isfinite(a) != std::isfinite(b)) ++different;
    if (std::isfinite(a) && std::isfinite(b)) worst = std::max(worst, std::abs(a - b));
  }
  EXPECT_GT(known, 0);
  EXPECT_EQ(different, 0);
  EXPECT_LT(worst, grey_levels);
}

// Hard: two views cannot outvote an error, so every occlusion and every repeated pattern is believed.
// Bound: on flat, textured ground 98 % of the cells within one GSD.
TEST(HardGeometry, two_views_suffice_on_flat_ground) {
  WorldProblem p({});
  p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(0, -90, 0), {-4, 0, 30}});
  p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(90, -90, 0), {4, 1, 30}});
  p.set_grid(64, 0.1, 0.1, -2, 2);
  const auto a = compare(
      p.problem, sweep_soundly(p.problem), [](double, double) { return 0.0; }, 0.1);
  EXPECT_GT(a.known, 0.98) << a;
  EXPECT_GT(a.within, 0.98) << a;
}

// Hard: more views than a tile can take (sweep::kMaxViews = 32 lie side by side on the stack).
// Bound: a choice of at most max_views of the 64, whatever the order in which they come; the sweep over them as good.
TEST(HardGeometry, of_64_views_those_that_serve_are_chosen_in_any_order) {
  WorldProblem p({});
  std::vector<index::ViewCandidate> candidates;
  for (int i = 0; i < 64; ++i) {
    const Vec3d center{(i % 8 - 3.5) * 1.5, (i / 8 - 3.5) * 1.5, 30 + 0.01 * i};
    candidates.push_back({"view" + std::to_string(100 + i),
                          camera::Camera(kCamera, {camera::rotation_from_yaw_pitch_roll(11.0 * i, -90, 0), center})});
  }
  index::ViewSelectionOptions options;
  options.views_per_place = options.max_views = sweep::kMaxViews;
  options.min_baseline_ratio = 0;
  const auto names = [&](const std::vector<index::ViewCandidate>& from) {
    std::vector<std::string> chosen;
    for (const int i : index::select_views(from, {{-3, -3}, {3, 3}}, -1, 1, options).chosen)
      chosen.push_back(from[i].name);
    return chosen;
  };
  const std::vector<std::string> chosen = names(candidates);
  EXPECT_EQ(chosen.size(), static_cast<std::size_t>(sweep::kMaxViews));
  std::vector<index::ViewCandidate> reversed(candidates.rbegin(), candidates.rend());
  EXPECT_EQ(names(reversed), chosen);

  for (const index::ViewCandidate& c : candidates)
    if (std::find(chosen.begin(), chosen.end(), c.name) != chosen.end()) p.add_view(c.camera.model(), c.camera.pose());
  p.set_grid(64, 0.1, 0.2, -2, 2);
  const auto a = compare(
      p.problem, sweep_soundly(p.problem), [](double, double) { return 0.0; }, 0.1);
  EXPECT_GT(a.known, 0.99) << a;
  EXPECT_GT(a.within, 0.99) << a;
}

// Hard: without a baseline every height explains the photographs equally well, and what differs is only chance.
// Bound: one of them is chosen for a tile, however they are turned, and the others' verdicts say why not.
TEST(HardGeometry, identical_centres_of_projection_serve_a_tile_once) {
  std::vector<index::ViewCandidate> candidates;
  for (int i = 0; i < 4; ++i) {
    const camera::Pose pose{camera::rotation_from_yaw_pitch_roll(60.0 * i, -90 + i, 1), {0.5, 0.25, 30}};
    candidates.push_back({"view" + std::to_string(i), camera::Camera(kCamera, pose)});
  }
  const auto selection = index::select_views(candidates, {{-3, -3}, {3, 3}}, -1, 1, {});
  EXPECT_EQ(selection.chosen.size(), 1u);
  for (const index::ViewVerdict& verdict : selection.verdicts) {
    if (verdict.chosen) continue;
    EXPECT_NE(verdict.reason.find("same position as view"), std::string::npos) << verdict.reason;
  }
}

struct Baseline {
  const char* name;
  double ratio, z_range, dz;
  double known, within_3sigma;  // bounds
};
std::ostream& operator<<(std::ostream& out, const Baseline& b) { return out << b.name; }
class HardBaseline : public testing::TestWithParam<Baseline> {};

// Hard: at 1/1000 of the height 10 m of height move a point by a tenth of a pixel, at twice the height the two
// photographs show the ground from 45 degrees on either side.
// Bound: what is claimed is true within three of the standard deviations claimed with it.
TEST_P(HardBaseline, what_is_claimed_is_true_within_its_own_sigma) {
  const Baseline& b = GetParam();
  BoxWorld world;
  world.ground_z = 0.37;  // on no plane
  WorldProblem p(world);
  const double half = 0.5 * b.ratio * 30;
  p.add_view(kCamera, looking_at({-half, 0.1, 30}, {0, 0, 0}));
  p.add_view(kCamera, looking_at({half, -0.1, 30}, {0, 0, 0}));
  p.set_grid(64, 0.1, b.dz, -b.z_range, b.z_range);
  const auto a = compare(
      p.problem, sweep_soundly(p.problem), [](double, double) { return 0.37; }, 0.1);
  EXPECT_GE(a.known, b.known) << a;
  if (a.known > 0) {
    EXPECT_GE(a.within_3sigma, b.within_3sigma) << a;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Ratios, HardBaseline,
    testing::Values(Baseline{"thousandth", 0.001, 12, 1, 0, 0.95}, Baseline{"hundredth", 0.01, 6, 0.5, 0, 0.95},
                    Baseline{"tenth", 0.1, 3, 0.2, 0.95, 0.95}, Baseline{"half", 0.5, 2, 0.1, 0.98, 0.95},
                    Baseline{"once", 1, 2, 0.05, 0.95, 0.95}, Baseline{"twice", 2, 2, 0.05, 0.9, 0.95}),
    [](const auto& i) { return std::string(i.param.name); });

// Hard: along a row the depth changes by a large part of itself, so a polynomial through a few projected cells no
// longer follows 1/depth. Bound: costs agree with the projection of every single cell to 0.02 grey levels.
TEST(HardGeometry, grazing_views_of_80_degrees_are_sampled_where_they_look) {
  WorldProblem p({});
  for (const double x : {-9.0, -8.0, -7.0}) p.add_view(kCamera, looking_at({x, 0.5 * x, 1.6}, {0, 0, 0}));
  p.set_grid(64, 0.2, 0.1, -0.6, 0.6);
  sweep_soundly(p.problem);
  expect_backends_agree(p.problem, 0.02);
}

// Hard: the ray to the cell is vertical, its direction on the ground undefined.
// Bound: the cell under the camera is as well known as the others, and coloured.
TEST(HardGeometry, camera_exactly_above_a_cell_centre) {
  WorldProblem p({});
  p.set_grid(65, 0.1, 0.1, -2, 2);
  const Vec2d cell = p.problem.grid.cell_center(32, 32);
  p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(0, -90, 0), {cell.x, cell.y, 30}});
  p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(90, -90, 0), {cell.x + 5, cell.y, 30}});
  p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(180, -90, 0), {cell.x, cell.y + 5, 30}});
  const auto result = sweep_soundly(p.problem);
  EXPECT_NEAR(result.height_m(32, 32), 0, 0.1);
  EXPECT_EQ(result.view_count(32, 32), 3);
  EXPECT_EQ(result.color(32, 32).a, 255);
}

// Hard: planes above the camera lie behind it, the one at its own height passes through its centre of projection,
// where 1/depth runs through infinity within a few cells.
// Bound: the plateau it flies below and the valley it sees are both found; costs agree with single projections.
TEST(HardGeometry, camera_below_the_top_of_the_terrain) {
  BoxWorld world;
  world.boxes = {{{1.5, -40, -1}, {40, 40, 8}}};
  WorldProblem p(world);
  // Three below the plateau's top (8 m) over the valley, three above with a longer lens.
  for (const double y : {-2.0, 0.1, 2.0}) p.add_view(kCamera, looking_at({-2.0, y, 7.0}, {-1.5, 0, 0}));
  for (const double y : {-7.0, 0.2, 7.0}) p.add_view(test::small_camera(1200), looking_at({-1.0, y, 34.0}, {0, 0, 3}));
  p.set_grid(64, 0.1, 0.1, -1, 9);
  p.match_levels();
  const auto result = sweep_soundly(p.problem);
  const auto truth = [&](double x, double y) { return p.world.top(x, y); };
  const auto a = compare(p.problem, result, truth, 0.15);
  EXPECT_GT(a.known, 0.95) << a;
  EXPECT_LT(a.median_error, 0.03) << a;
  EXPECT_GT(a.within, 0.85) << a;  // three views into the corner below a wall of 8 m
  expect_backends_agree(p.problem, 0.05);
}

// Hard: a camera within the searched planes meets cells at depths from nothing to a few metres in one row; pixels run
// through 10^9, beyond what a 32-bit number holds. Bound: as above; nothing crashes under a sanitizer.
TEST(HardGeometry, plane_through_the_centre_of_projection) {
  WorldProblem p({});
  for (const double x : {-0.3, 0.0, 0.31})
    p.add_view(kCamera, {camera::rotation_from_yaw_pitch_roll(20, -50, 7), {x, 0.2, 1.0}});
  p.set_grid(64, 0.05, 0.05, -1, 1.5);
  for (const double off : {1e-9, -1e-9, 0.0}) {  // just above, just below and exactly at the 20th plane
    for (sweep::View& view : p.problem.views)
      view.camera = camera::Camera(view.camera.model(),
                                   {view.camera.pose().cam_from_world, {view.camera.pose().center.x, 0.2, 1.0 + off}});
    sweep_soundly(p.problem);
    expect_backends_agree(p.problem, 0.05);
  }
}

// Hard: the photograph is a crop from far off the axis (a shift lens, a tile of a large frame): its own middle says
// nothing about where it looks. Bound: as good as a centred camera.
TEST(HardGeometry, principal_point_outside_the_image) {
  WorldProblem p({});
  camera::CameraModel model = kCamera;
  model.cx_px = -400;
  model.cy_px = 500;
  for (int i = 0; i < 4; ++i) {
    // Where the middle of the crop looks, seen from straight above.
    const camera::Pose at_origin{camera::rotation_from_yaw_pitch_roll(90.0 * i, -90, 0), {0, 0, 30}};
    const auto ground = camera::Camera(model, at_origin).at_height({160, 120}, 0);
    ASSERT_TRUE(ground);
    const Vec3d center{-ground->x + 4 * (i % 2), -ground->y + 4 * (i / 2), 30};
    p.add_view(model, {at_origin.cam_from_world, center});
  }
  p.set_grid(64, 0.1, 0.05, -1, 1);
  const auto a = compare(
      p.problem, sweep_soundly(p.problem), [](double, double) { return 0.0; }, 0.1);
  EXPECT_GT(a.known, 0.95) << a;
  EXPECT_GT(a.within, 0.95) << a;
}

// Hard: of the whole image only the part inside the fold has one direction per pixel; at the fold the inverse of the
// lens has an infinite slope. Bound: up to 0.9999 of the fold radius directions come back to within the square root of
// what doubles resolve; beyond, nothing is shown twice.
TEST(HardGeometry, strong_distortion_near_where_it_folds) {
  camera::CameraModel model{320, 240, 150, 150, 160, 120, {.k1 = -0.35}};
  const double fold = std::sqrt(camera::fold_radius_squared(model.distortion));
  for (const double share : {0.5, 0.9, 0.99, 0.999, 0.9999}) {
    for (int k = 0; k < 8; ++k) {
      const Vec2d n{share * fold * std::cos(0.3 + k), share * fold * std::sin(0.3 + k)};
      const auto back = camera::undistort(model.distortion, camera::distort(model.distortion, n));
      ASSERT_TRUE(back) << share;
      EXPECT_LT(norm(*back - n), 1e-6) << share;
    }
  }
  const camera::Camera camera(model, {camera::rotation_from_yaw_pitch_roll(0, -90, 0), {0, 0, 10}});
  EXPECT_FALSE(camera.project({10 * fold * 1.0001, 0, 0}));
  EXPECT_TRUE(camera.project({10 * fold * 0.9999, 0, 0}));
}

// The same lens in the sweep. Bound: heights hold well into the compressed border of the image, costs agree with single
// projections right up to the fold, and cells that lie beyond it in all views are unknown.
TEST(HardGeometry, sweeping_through_a_lens_up_to_its_fold) {
  BoxWorld world;
  world.gsd_m = 0.05;
  WorldProblem p(world);
  const camera::CameraModel model{400, 400, 300, 300, 200, 200, {.k1 = -0.35}};
  const double fold_m = 15 * std::sqrt(camera::fold_radius_squared(model.distortion));  // on the ground
  for (int i = 0; i < 4; ++i)
    p.add_view(model, {camera::rotation_from_yaw_pitch_roll(90.0 * i, -90, 0), {(i % 2) * 6.0, (i / 2) * 6.0, 15}});
  p.set_grid(128, 0.15, 0.1, -1, 1);
  p.problem.grid.north_west_corner = {-16, 16};
  p.match_levels();
  const auto result = sweep_soundly(p.problem);
  int inside = 0, right = 0, beyond = 0;
  for (int y = 0; y < p.problem.grid.height; ++y) {
    for (int x = 0; x < p.problem.grid.width; ++x) {
      const Vec2d cell = p.problem.grid.cell_center(x, y);
      int seen = 0, well_seen = 0;
      for (const sweep::View& view : p.problem.views) {
        const Vec3d c = view.camera.pose().center;
        const double radius = norm(cell - Vec2d{c.x, c.y});
        seen += radius < fold_m * 1.1;  // planes up to 1 m change the angle
        well_seen += radius < fold_m * 0.7;
      }
      inside += well_seen == 4;
      right += well_seen == 4 && std::abs(result.height_m(x, y)) < 0.2;
      beyond += seen < 2 && !std::isnan(result.height_m(x, y));
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(right, 0.9 * inside) << right << " of " << inside;
  EXPECT_EQ(beyond, 0);
  expect_backends_agree(p.problem, 0.05);
}

// Hard: a height needs two; one view alone always agrees with itself.
// Bound: no height there; with the planar fallback a colour, marked as such.
TEST(HardGeometry, a_cell_seen_by_one_view_is_unknown) {
  WorldProblem p({});
  const Mat3d down = camera::rotation_from_yaw_pitch_roll(0, -90, 0);
  p.add_view(kCamera, {down, {-14, 0, 30}});  // shows x in -30..2
  p.add_view(kCamera, {down, {14, 0, 30}});   // shows x in -2..30
  p.set_grid(128, 0.1, 0.1, -0.5, 0.5);
  p.problem.options.planar_fallback = true;
  const auto result = sweep_soundly(p.problem);
  for (int y = 0; y < 128; ++y)
    for (const int x : {0, 20, 40, 87, 107, 127}) {
      EXPECT_TRUE(std::isnan(result.height_m(x, y)));
      EXPECT_EQ(result.planar(x, y), 1);
      EXPECT_EQ(result.color(x, y).a, 255);
    }
}

}  // namespace
}  // namespace skysweep::hard
