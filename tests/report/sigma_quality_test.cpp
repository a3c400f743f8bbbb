// SPDX-License-Identifier: Apache-2.0
#include "report/sigma_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "rasters.h"

namespace skysweep::report {
namespace {

TEST(SigmaQuality, contamination_of_five_heights_by_hand) {
  // By growing sigma: good, good, outlier, good, outlier; one hole, one height without sigma.
  const std::vector<float> dz = {9, 0.1f, -0.2f, -5, 0.3f, kHole, 0.1f};
  const std::vector<float> sigma = {5, 1, 2, 3, 4, 1, kHole};
  const SigmaQuality q = sigma_quality(dz, sigma, 10, 1);
  EXPECT_EQ(q.without_sigma, 1);
  EXPECT_EQ(q.overall.count, 5);
  EXPECT_EQ(q.outlier_m, 1);
  ASSERT_EQ(q.curve.size(), 5u);
  const double contamination[] = {0, 0, 1. / 3, 1. / 4, 2. / 5};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(q.curve[i].sigma_m, static_cast<double>(i + 1));
    EXPECT_DOUBLE_EQ(q.curve[i].completeness, static_cast<double>(i + 1) / 10);
    EXPECT_DOUBLE_EQ(q.curve[i].contamination, contamination[i]);
  }
  for (const CompletenessLimit& limit : q.limits) {
    EXPECT_EQ(limit.best.sigma_m, 2);
    EXPECT_DOUBLE_EQ(limit.best.completeness, 0.2);
    EXPECT_EQ(limit.best.contamination, 0);
  }
  EXPECT_TRUE(q.deciles.empty());  // fewer than ten heights
}

TEST(SigmaQuality, the_most_complete_threshold_may_lie_beyond_a_worse_one) {
  // After one outlier among the best the contamination falls below 5 % again at 20 heights, below 1 % at 100.
  std::vector<float> dz(150, 0), sigma(150);
  for (std::size_t i = 0; i < dz.size(); ++i) sigma[i] = static_cast<float>(i + 1);
  dz[0] = 7;
  dz[149] = 7;
  const SigmaQuality q = sigma_quality(dz, sigma, 200, 1);
  EXPECT_EQ(q.limits[0].allowed_contamination, 0.01);
  EXPECT_DOUBLE_EQ(q.limits[0].best.completeness, 149. / 200);
  EXPECT_EQ(q.limits[1].allowed_contamination, 0.05);
  EXPECT_DOUBLE_EQ(q.limits[1].best.completeness, 150. / 200);
}

TEST(SigmaQuality, heights_of_equal_sigma_are_kept_together) {
  const std::vector<float> dz = {0, 0, 9}, sigma = {1, 1, 1};
  const SigmaQuality q = sigma_quality(dz, sigma, 3, 1);
  ASSERT_EQ(q.curve.size(), 1u);
  EXPECT_DOUBLE_EQ(q.curve[0].contamination, 1. / 3);
  EXPECT_EQ(q.limits[0].best.completeness, 0);
  EXPECT_TRUE(std::isnan(q.limits[0].best.sigma_m));
}

// `promised` is what the layer says of errors whose standard deviation is 1.
SigmaQuality normal_errors(double promised) {
  constexpr int kCount = 40000;
  std::vector<float> dz(kCount), sigma(kCount);
  Random random(11);
  for (int i = 0; i < kCount; ++i) {
    const double scale = 0.5 + i % 10 * 0.1;
    dz[i] = static_cast<float>(scale * random.normal());
    sigma[i] = static_cast<float>(scale * promised);
  }
  return sigma_quality(dz, sigma, kCount, 10);
}

TEST(SigmaQuality, a_true_sigma_covers_what_it_promises_in_every_tenth) {
  const SigmaQuality q = normal_errors(1);
  EXPECT_NEAR(q.overall.within_68, 0.6827, 0.01);
  EXPECT_NEAR(q.overall.within_95, 0.95, 0.01);
  ASSERT_EQ(q.deciles.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(q.deciles[i].count, 4000);
    EXPECT_NEAR(q.deciles[i].median_sigma_m, 0.5 + 0.1 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(q.deciles[i].le68_m / q.deciles[i].median_sigma_m, 1, 0.05);
    EXPECT_NEAR(q.deciles[i].within_68, 0.6827, 0.03);
  }
}

TEST(SigmaQuality, a_sigma_of_half_or_twice_the_truth_shows_in_the_coverage) {
  EXPECT_NEAR(normal_errors(0.5).overall.within_68, 0.3829, 0.01);  // erf(0.5 / sqrt 2)
  EXPECT_NEAR(normal_errors(0.5).overall.within_95, 0.6729, 0.01);  // erf(0.98 / sqrt 2)
  EXPECT_NEAR(normal_errors(2).overall.within_68, 0.9545, 0.01);
}

TEST(SigmaQuality, a_constant_sigma_covers_but_does_not_sort) {
  const std::vector<float> dz = {0.5f, 1.5f, -0.5f, -1.5f}, sigma(4, 1);
  const SigmaQuality q = sigma_quality(dz, sigma, 4, 1);
  EXPECT_DOUBLE_EQ(q.overall.within_68, 0.5);
  EXPECT_DOUBLE_EQ(q.overall.within_95, 1);
  ASSERT_EQ(q.curve.size(), 1u);  // all or nothing
  EXPECT_DOUBLE_EQ(q.curve[0].contamination, 0.5);
}

TEST(SigmaQuality, nothing_known_is_no_number) {
  const std::vector<float> none = {kHole};
  const SigmaQuality q = sigma_quality(none, none, 1, 1);
  EXPECT_EQ(q.overall.count, 0);
  EXPECT_TRUE(std::isnan(q.overall.within_68));
  EXPECT_TRUE(std::isnan(q.overall.le68_m));
  EXPECT_TRUE(q.curve.empty());
}

TEST(SigmaQuality, each_class_has_its_own_coverage) {
  ClassMap classes{Array2d<std::uint8_t>(4, 1), {"none", "ground", "roof"}};
  for (int i = 0; i < 4; ++i) classes.codes(i, 0) = i < 2 ? 1 : i;
  const std::vector<float> dz = {0.5f, 2, 0.5f, kHole}, sigma(4, 1);
  const std::vector<ClassCoverage> c = coverage_by_class(dz, sigma, classes);
  ASSERT_EQ(c.size(), 2u);  // class 3 has no height
  EXPECT_EQ(c[0].name, "ground");
  EXPECT_DOUBLE_EQ(c[0].coverage.within_68, 0.5);
  EXPECT_EQ(c[1].code, 2);
  EXPECT_EQ(c[1].name, "roof");
  EXPECT_DOUBLE_EQ(c[1].coverage.within_68, 1);
}

TEST(SigmaQuality, long_curves_are_thinned_and_end_with_everything) {
  std::vector<float> dz(1000, 0), sigma(1000);
  for (std::size_t i = 0; i < dz.size(); ++i) sigma[i] = static_cast<float>(i);
  const SigmaQuality q = sigma_quality(dz, sigma, 1000, 1);
  EXPECT_EQ(q.curve.size(), 200u);
  EXPECT_EQ(q.curve.back().completeness, 1);
}

}  // namespace
}  // namespace skysweep::report
