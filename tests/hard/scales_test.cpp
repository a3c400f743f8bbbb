// SPDX-License-Identifier: Apache-2.0
// Hard cases of scale: the same scene from a microscope's stage to a mountain range, heights far from zero, plane steps
// from a millimetre to ten metres.
#include "hard/box_world.h"
#include "hard/sound_result.h"
#include "tiles/lattice.h"

namespace skysweep::hard {
namespace {

// A step of 15 GSD on level ground seen by five views from 300 GSD above.
WorldProblem step_scene(double gsd, double ground_z, double dz, double planes_below, double planes_above) {
  BoxWorld world;
  world.ground_z = ground_z;
  world.gsd_m = gsd;
  world.boxes = {{{4 * gsd, -500 * gsd, ground_z}, {500 * gsd, 500 * gsd, ground_z + 15 * gsd}}};
  return WorldProblem(world, [&](WorldProblem& p) {
    p.add_ring(5, test::small_camera(), 60 * gsd, ground_z + 300 * gsd);
    p.set_grid(64, gsd, dz, ground_z - planes_below * dz, ground_z + planes_above * dz);
  });
}

struct Scale {
  const char* name;
  double factor;
};
std::ostream& operator<<(std::ostream& out, const Scale& scale) { return out << scale.name; }
class HardScale : public testing::TestWithParam<Scale> {};

// Filled cells have none.
bool same_sigma(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Hard: any absolute tolerance hidden in the code (a millimetre of slack, an epsilon) decides at one of these scales.
// Bound: scaled by a power of two, which is exact in binary, every height and sigma scales with it bit for bit.
TEST_P(HardScale, heights_scale_bit_for_bit_with_the_scene) {
  constexpr double kGsd = 0.125;
  const double factor = GetParam().factor;
  const WorldProblem usual = step_scene(kGsd, 0, kGsd, 8, 24);
  const WorldProblem scaled = step_scene(kGsd * factor, 0, kGsd * factor, 8, 24);
  const auto a = sweep_soundly(usual.problem), b = sweep_soundly(scaled.problem);
  int known = 0, different = 0;
  for (std::size_t i = 0; i < a.height_m.size(); ++i) {
    const float za = a.height_m.data()[i], zb = b.height_m.data()[i];
    known += !std::isnan(za);
    different += std::isnan(za)
                     ? !std::isnan(zb)
                     : static_cast<float>(za * factor) != zb ||
                           !same_sigma(static_cast<float>(a.sigma_m.data()[i] * factor), b.sigma_m.data()[i]);
  }
  EXPECT_GT(known, 3500);
  EXPECT_EQ(different, 0);
  EXPECT_EQ(a.color, b.color);
}
INSTANTIATE_TEST_SUITE_P(Scales, HardScale,
                         testing::Values(Scale{"microscope_4_micrometres", 0x1p-15},
                                         Scale{"quarry_stone_1_millimetre", 0x1p-7}, Scale{"town_2_metres", 0x1p4},
                                         Scale{"mountains_16_metres", 0x1p7}),
                         [](const auto& i) { return std::string(i.param.name); });

struct Heights {
  const char* name;
  double gsd, ground_z, dz, planes_below, planes_above;
  double median;  // bound on the error
};
std::ostream& operator<<(std::ostream& out, const Heights& h) { return out << h.name; }
class HardHeights : public testing::TestWithParam<Heights> {};

// Hard: plane numbers are negative or change their sign within the range, where truncation and floor part; heights of
// kilometres leave single precision a millimetre; steps far finer than the parallax they make leave neighbouring
// planes alike, far coarser ones leave nothing between. Bound: the median error, and 90 % within two GSD.
TEST_P(HardHeights, are_found_to_a_share_of_the_gsd) {
  const Heights& h = GetParam();
  const WorldProblem p = step_scene(h.gsd, h.ground_z, h.dz, h.planes_below, h.planes_above);
  const auto truth = [&](double x, double y) { return p.world.top(x, y); };
  const auto a = compare(p.problem, sweep_soundly(p.problem), truth, 2 * h.gsd);
  EXPECT_GT(a.known, 0.9) << a;
  EXPECT_LT(a.median_error, h.median) << a;
  EXPECT_GT(a.within, 0.9) << a;
}
INSTANTIATE_TEST_SUITE_P(Ranges, HardHeights,
                         testing::Values(Heights{"below_zero", 0.1, -412.37, 0.1, 8, 24, 0.02},
                                         Heights{"across_zero", 0.1, -0.73, 0.1, 8, 24, 0.02},
                                         Heights{"roof_at_zero", 0.1, -1.5, 0.1, 8, 18, 0.02},
                                         Heights{"summit_of_8848_m", 0.1, 8848.86, 0.1, 8, 24, 0.025},
                                         Heights{"step_of_1_mm_at_gsd_1_mm", 0.001, 101.3, 0.001, 8, 24, 0.0003},
                                         Heights{"step_of_1_mm_at_gsd_1_cm", 0.01, 0.3, 0.001, 60, 200, 0.002},
                                         Heights{"step_of_1_m_at_gsd_1_m", 1, 5, 1, 8, 24, 0.3},
                                         Heights{"step_of_10_m_at_gsd_10_m", 10, 1234, 10, 8, 24, 3}),
                         [](const auto& i) { return std::string(i.param.name); });

// Hard: z / dz for kilometres and millimetres exceeds what a float counts. Bound: planes bracket the range exactly.
TEST(HardPlanes, bracket_the_range_far_from_zero_and_across_it) {
  for (const double z : {-8000.0005, -0.0005, 0.0, 0.0005, 8848.8605}) {
    for (const double dz : {0.001, 0.1, 10.0}) {
      const sweep::PlaneRange planes = sweep::planes_between(z, z + 0.01, dz, 0);
      EXPECT_LE(planes.first * dz, z);
      EXPECT_GE(planes.last * dz, z + 0.01 - 1e-12);
      EXPECT_GT((planes.first + 1) * dz, z);
    }
  }
}

}  // namespace
}  // namespace skysweep::hard
