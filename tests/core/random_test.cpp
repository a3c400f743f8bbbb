// SPDX-License-Identifier: Apache-2.0
#include "core/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace skysweep {
namespace {

TEST(Random, mix64_gives_the_published_splitmix64_sequence) {
  // First outputs of SplitMix64 seeded with 0 (Vigna's reference implementation).
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafull);
  EXPECT_EQ(mix64(kGolden), 0x6e789e6aa1b965f4ull);
  EXPECT_EQ(mix64(2 * kGolden), 0x06c45d188009454full);
}

TEST(Random, same_seed_same_numbers_other_seed_other_numbers) {
  Random a(7), b(7), c(8);
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t value = a.next();
    EXPECT_EQ(value, b.next());
    EXPECT_NE(value, c.next());
  }
}

TEST(Random, uniform_stays_in_its_range_and_has_its_moments) {
  Random random(1);
  constexpr int kCount = 200'000;
  double sum = 0, sum_squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum_squares += u * u;
  }
  // Five standard errors of the mean of u and of u^2.
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(sum_squares / kCount, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kCount));
}

TEST(Random, normal_has_mean_zero_variance_one_and_the_right_tails) {
  Random random(2);
  constexpr int kCount = 200'000;
  double sum = 0, sum_squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double n = random.normal();
    ASSERT_TRUE(std::isfinite(n));
    sum += n;
    sum_squares += n * n;
    beyond_two += std::abs(n) > 2;
  }
  EXPECT_NEAR(sum / kCount, 0, 5 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(sum_squares / kCount, 1, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 5 * std::sqrt(0.0455 / kCount));
}

TEST(Random, below_reaches_every_value_equally_often) {
  Random random(3);
  std::array<int, 7> counts{};
  constexpr int kCount = 70'000;
  for (int i = 0; i < kCount; ++i) ++counts.at(random.below(7));
  for (const int count : counts) EXPECT_NEAR(count, kCount / 7, 5 * std::sqrt(kCount / 7.0));
}

}  // namespace
}  // namespace skysweep
