// SPDX-License-Identifier: Apache-2.0
// The matching cost of a point in space in double precision: how much the views that show it differ there.
// The reference search and the choice of colour are built on it.
#pragma once

#include <array>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

constexpr int kMaxWindowLevels = 9;

// What the views show at a point. Only the first `count` entries (and `levels` rows) are set.
struct ViewSamples {
  int count = 0;                                                          // views that show the point
  int levels = 0;                                                         // window levels
  std::array<int, kMaxViews> view;                                        // their positions in problem.views, ascending
  std::array<Vec2d, kMaxViews> pixel;                                     // where they show it
  std::array<std::array<double, kMaxViews>, kMaxWindowLevels> luminance;  // grey levels

  // Mean absolute difference of two of the views over the window levels.
  double difference(int i, int k) const;
};

// The views that show the point and where: no luminance yet.
ViewSamples views_showing(const SweepProblem& problem, Vec3d point);
// Their luminance.
void sample_windows(const SweepProblem& problem, ViewSamples& samples);
// Both.
ViewSamples sample_views(const SweepProblem& problem, Vec3d point);

// C_k = 1 / (n - 1) sum over the other views of their difference to view k (divided by the number of terms so that
// costs of different n compare). Zero with fewer than two views.
std::array<double, kMaxViews> view_costs(const ViewSamples& samples);

// The matching cost AC of the point, as options.aggregation says, plus few_views_penalty / n; infinity with fewer than
// min_views views.
double matching_cost(const ViewSamples& samples, const SweepOptions& options);

// How many of n views Aggregation::consensus takes: their share, rounded up, but no fewer than three if there are so
// many. Two agree by chance too easily.
int consensus_size(int n, double share);
constexpr int kSmallestConsensus = 3;
constexpr double kShareSlack = 1e-4;  // what rounding may add to n times the share without another view being needed

// A view whose C_k is above the consensus's highest, `limit`, still counts a little: its weight falls from 1 at the
// limit to 0 at limit (1 + kConsensusSoftness) + kConsensusSoftnessGrey. So the cost does not jump where two views
// change ranks, and rounding does not decide which of them counts.
constexpr double kConsensusSoftness = 0.1, kConsensusSoftnessGrey = 1. / 64;

// Mean of the `used` lowest of the first `count` costs.
double mean_of_lowest(std::array<double, kMaxViews> costs, int count, int used);

// How much each of the first `count` views, with these C_k (grey levels), counts for the consensus: 0 to 1.
std::array<double, kMaxViews> consensus_weights(const std::array<double, kMaxViews>& costs, int count, double share);

}  // namespace skysweep::sweep
