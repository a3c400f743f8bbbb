// SPDX-License-Identifier: Apache-2.0
// Hard cases of what the photographs show: nothing, too much, the same over and over, or noise.
#include <iostream>

#include "hard/box_world.h"
#include "hard/sound_result.h"
#include "sweep/depth_probe.h"
#include "sweep/height_range.h"

namespace skysweep::hard {
namespace {

const camera::CameraModel kCamera = test::small_camera();

double level(double, double) { return 0; }

// What the pipeline does before it believes anything: is there a surface that can be trusted at all?
double trusted_share(const sweep::SweepProblem& problem, double z_low, double z_high) {
  SerialExecutor serial;
  const Array2d<float> surface = sweep::coarse_surface(problem, z_low, z_high, sweep::Backend::cpu, serial);
  const auto known = std::count_if(surface.begin(), surface.end(), [](float z) { return !std::isnan(z); });
  return static_cast<double>(known) / static_cast<double>(surface.size());
}

struct Flat {
  const char* name;
  double grey;
};
std::ostream& operator<<(std::ostream& out, const Flat& flat) { return out << flat.name; }
class HardFlatImages : public testing::TestWithParam<Flat> {};

// Hard: every height explains the photographs perfectly, and where the number of views changes with height the price
// of few views alone makes a minimum. Bound: no cell claims a height, nor finds the coarse search a surface, nor the
// probe a depth.
TEST_P(HardFlatImages, claim_nothing) {
  WorldProblem p({});
  const double grey = GetParam().grey;
  p.add_ring(7, kCamera, 6, 30, [grey](Vec3d) { return grey; });
  p.set_grid(128, 0.3, 0.3, -4, 4);  // wider than any photograph: views come and go
  const auto a = compare(p.problem, sweep_soundly(p.problem), level, 0.2);
  EXPECT_EQ(a.known, 0) << a;
  EXPECT_EQ(trusted_share(p.problem, -4, 4), 0);
  const std::vector<sweep::View>& views = p.problem.views;
  EXPECT_FALSE(sweep::probe_depth(views[0], {views.begin() + 1, views.end()}));
}
INSTANTIATE_TEST_SUITE_P(Images, HardFlatImages,
                         testing::Values(Flat{"all_black", 0}, Flat{"saturated", 255}, Flat{"textureless", 100}),
                         [](const auto& i) { return std::string(i.param.name); });

// Hard: the same grey with the noise of a sensor: a shift by chance always matches a little better.
// Bound: the coarse search trusts no surface, so that the pipeline claims nothing.
TEST(HardImages, noise_only_is_trusted_nowhere) {
  WorldProblem p({});
  Random random(3);
  p.add_ring(7, kCamera, 6, 30, [&](Vec3d) { return random.uniform(0, 255); });
  p.set_grid(128, 0.1, 0.1, -4, 4);
  sweep_soundly(p.problem);
  EXPECT_EQ(trusted_share(p.problem, -4, 4), 0);
  const std::vector<sweep::View>& views = p.problem.views;
  EXPECT_FALSE(sweep::probe_depth(views[0], {views.begin() + 1, views.end()}));
}

// Hard: a tiling with a period of 1 m makes every height at which the views shift by whole periods look right to a
// pair. Bound: with seven views around, which no other height serves at once, 97 % of the cells are right.
TEST(HardImages, repeating_pattern_is_resolved_by_many_views) {
  WorldProblem p({});
  const Shade tiles = [&](Vec3d point) {
    const auto wrapped = [](double v) { return v - std::floor(v); };
    return test::ground_texture(wrapped(point.x), wrapped(point.y));
  };
  p.add_ring(7, kCamera, 6, 30, tiles);
  p.set_grid(64, 0.1, 0.1, -6, 6);
  const auto a = compare(p.problem, sweep_soundly(p.problem), level, 0.1);
  EXPECT_GT(a.known, 0.95) << a;
  EXPECT_GT(a.within, 0.97) << a;
}

// Hard: a column of pixels has no window, no mipmap but itself, and every position is half outside.
// Bound: no crash in pyramid, probe and sweep; what is claimed is sound.
TEST(HardImages, one_pixel_wide_images) {
  for (const auto& [width, height] : {std::pair{1, 240}, {320, 1}, {1, 1}, {2, 3}}) {
    WorldProblem p({});
    const camera::CameraModel model = test::small_camera(300, width, height);
    p.add_ring(4, model, 3, 30);
    p.set_grid(64, 0.1, 0.1, -2, 2);
    sweep_soundly(p.problem);
    trusted_share(p.problem, -2, 2);
    const std::vector<sweep::View>& views = p.problem.views;
    EXPECT_FALSE(sweep::probe_depth(views[0], {views.begin() + 1, views.end()})) << width << " x " << height;
  }
}

// Hard: a known range of a few plane steps leaves hardly any wrong height to compare the right one with.
// Bound: the coarse search finds the ground in a range of a single GSD as it does in one of 80.
TEST(HardImages, a_range_as_narrow_as_the_ground_is_searched_as_well_as_a_wide_one) {
  WorldProblem p({});
  p.add_ring(7, kCamera, 6, 30);
  p.set_grid(128, 0.1, 0.1, -4, 4);
  EXPECT_GT(trusted_share(p.problem, -4, 4), 0.65);
  EXPECT_GT(trusted_share(p.problem, -0.05, 0.05), 0.65);
  EXPECT_EQ(trusted_share(p.problem, 3, 4), 0);  // the ground lies outside
}

// Hard: a part of each photograph is burnt out. Bound: the rest is right, and of the burnt part nothing is claimed
// beyond the reach of the windows: 5 pixels of the coarsest level (8 x 8), that pixel and the next, and the parallax of
// 2 m: 60 cells.
TEST(HardImages, saturated_part) {
  WorldProblem p({});
  p.add_ring(7, kCamera, 6, 30, [&](Vec3d point) { return point.x > -2.4 ? 255.0 : p.world.grey(point); });
  p.set_grid(128, 0.1, 0.1, -2, 2);
  const auto result = sweep_soundly(p.problem);
  constexpr int kBorder = 40, kReach = 60;
  int right = 0, claimed = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < kBorder; ++x) right += std::abs(result.height_m(x, y)) < 0.1;
    for (int x = kBorder + kReach; x < 128; ++x) claimed += !std::isnan(result.height_m(x, y));
  }
  EXPECT_GT(right, 0.98 * kBorder * 128);
  EXPECT_EQ(claimed, 0);
}

// Hard: neighbours a micrometre and others 1000 km away (positions not yet known): the parallax to search spans twelve
// orders of magnitude. Bound: the probe searches no more than its 512 planes.
TEST(HardImages, probing_against_neighbours_of_absurd_distance) {
  WorldProblem p({});
  p.add_ring(3, kCamera, 6, 30);
  std::vector<sweep::View>& views = p.problem.views;
  const camera::Pose pose = views[0].camera.pose();
  views[1].camera = camera::Camera(kCamera, {pose.cam_from_world, pose.center + Vec3d{0x1p-20, 0, 0}});
  views[2].camera = camera::Camera(kCamera, {pose.cam_from_world, pose.center + Vec3d{1e6, 0, 0}});
  EXPECT_FALSE(sweep::probe_depth(views[0], {views.begin() + 1, views.end()}));
}

}  // namespace
}  // namespace skysweep::hard
