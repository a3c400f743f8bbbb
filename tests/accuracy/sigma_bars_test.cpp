// SPDX-License-Identifier: Apache-2.0
#include "accuracy/sigma_bars.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/random.h"

namespace skysweep::accuracy {
namespace {

// Errors as a town has them: three in ten cells measured half as well as the others, one in twenty off by metres.
struct Errors {
  std::vector<float> dz, true_sigma;
};

Errors mixed_errors() {
  constexpr int kCount = 40000;
  Errors out;
  Random random(5);
  for (int i = 0; i < kCount; ++i) {
    const double sigma = (i % 20 == 0 ? 3 : i % 10 < 3 ? 0.02 : 0.01) * random.uniform(0.95, 1.05);
    out.true_sigma.push_back(static_cast<float>(sigma));
    out.dz.push_back(static_cast<float>(sigma * random.normal()));
  }
  return out;
}

TEST(SigmaBars, hold_for_the_true_sigma) {
  const Errors errors = mixed_errors();
  for (const auto& [name, miss] : sigma_misses(report::sigma_quality(errors.dz, errors.true_sigma, 40000, 1)))
    EXPECT_EQ(miss, 0) << name;
}

TEST(SigmaBars, fail_for_any_constant_sigma) {
  // Even with the constant that covers 68.3 % of all: nothing else holds. Cells of equal sigma are ordered by error.
  const Errors errors = mixed_errors();
  for (const double factor : {0.5, 0.8, 1.0, 1.25, 2.0, 10.0}) {
    const double le68 = report::sigma_quality(errors.dz, errors.true_sigma, 40000, 1).overall.le68_m;
    const std::vector<float> constant(errors.dz.size(), static_cast<float>(factor * le68));
    auto misses = sigma_misses(report::sigma_quality(errors.dz, constant, 40000, 1));
    EXPECT_GT(misses["sigma_tenths_68_miss"], 0.1) << factor;
    EXPECT_GT(misses["sigma_tenths_95_miss"], 0) << factor;
  }
}

TEST(SigmaBars, judge_ground_roofs_and_trees_alone) {
  report::SigmaQuality quality;
  quality.overall = {5000, 0.70, 0.95, 1, 1};
  quality.classes = {{1, "ground", {2000, 0.70, 0.95, 1, 1}},
                     {2, "roof", {2000, 0.85, 0.999, 1, 1}},
                     {3, "facade edge", {2000, 0.2, 0.2, 1, 1}},
                     {4, "tree", {kFewestJudged - 1, 0.2, 0.2, 1, 1}}};
  auto misses = sigma_misses(quality);
  EXPECT_EQ(misses["sigma_ground_68_miss"], 0);
  EXPECT_NEAR(misses["sigma_roof_68_miss"], 0.05, 1e-9);
  EXPECT_NEAR(misses["sigma_roof_95_miss"], 0.009, 1e-9);
  EXPECT_FALSE(misses.contains("sigma_facade edge_68_miss"));
  EXPECT_FALSE(misses.contains("sigma_tree_68_miss"));
}

}  // namespace
}  // namespace skysweep::accuracy
