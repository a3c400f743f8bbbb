// SPDX-License-Identifier: Apache-2.0
#include "sweep/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "sweep/linear_light.h"

namespace skysweep::sweep {
namespace {

// Cells of random grey seen by the views that `sees` names, each with its gain on linear light and noise.
template <typename Sees>
Array2d<CellCandidates> cells_seen(const std::vector<double>& gains, Sees sees, int noise) {
  Random random(3);
  Array2d<CellCandidates> cells(120, 120);
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x) {
      CellCandidates& cell = cells(x, y);
      const int grey = 60 + static_cast<int>(random.below(100));
      for (int v = 0; v < static_cast<int>(gains.size()); ++v) {
        if (!sees(v, x)) continue;
        const float light = linear_light(static_cast<std::uint8_t>(grey)) * static_cast<float>(gains[v]);
        const int error = static_cast<int>(random.below(2 * noise + 1)) - noise;
        const auto byte = static_cast<std::uint8_t>(encoded_light(light) + error);
        cell.of[cell.count++] = {{byte, byte, byte}, static_cast<std::int8_t>(v), 0};
      }
    }
  return cells;
}

TEST(Exposure, bytes_survive_the_way_to_linear_light_and_back) {
  for (int i = 0; i < 256; ++i)
    EXPECT_EQ(encoded_light(linear_light(static_cast<std::uint8_t>(i))), static_cast<std::uint8_t>(i));
  EXPECT_NEAR(linear_light(188), 0.5, 0.005);
  EXPECT_EQ(encoded_light(7), 255);
  EXPECT_EQ(encoded_light(-1), 0);
}

TEST(Exposure, gains_are_found_along_a_chain_of_views_that_overlap) {
  const std::vector<double> gains = {1, 1.4, 0.8, 1.1, 0.7};
  const auto found = estimate_exposures(cells_seen(
                                            gains, [](int v, int x) { return x / 24 == v || x / 24 == v + 1; }, 3),
                                        5);
  ASSERT_EQ(found.size(), gains.size());
  for (std::size_t v = 1; v < gains.size(); ++v)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[v][c] - found[0][c], std::log(gains[v]), 0.02) << v;
}

TEST(Exposure, noise_alone_is_no_difference) {
  const auto all = [](int, int) { return true; };
  EXPECT_TRUE(estimate_exposures(cells_seen({1, 1, 1, 1}, all, 12), 4).empty());
  EXPECT_FALSE(estimate_exposures(cells_seen({1, 1, 1.05, 1}, all, 3), 4).empty());
}

TEST(Exposure, views_that_share_no_place_with_others_change_nothing_of_theirs) {
  const std::vector<double> gains = {1, 1.3, 0.5};
  const auto found = estimate_exposures(cells_seen(
                                            gains, [](int v, int x) { return (v == 2) == (x > 100); }, 1),
                                        3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[1][0] - found[0][0], std::log(1.3), 0.02);
  EXPECT_NEAR(found[2][0], 0, 1e-9);
}

TEST(Exposure, no_views_no_difference) {
  EXPECT_TRUE(estimate_exposures(Array2d<CellCandidates>(8, 8), 0).empty());
  EXPECT_TRUE(estimate_exposures(Array2d<CellCandidates>(8, 8), 2).empty());
}

}  // namespace
}  // namespace skysweep::sweep
