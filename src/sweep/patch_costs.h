// SPDX-License-Identifier: Apache-2.0
// The matching costs that compare patches instead of single pixels, in double precision: zero-mean normalised
// cross-correlation and census (Zabih and Woodfill 1994). Both turn the patch that a view shows around a cell into a
// vector p and differ only in that:
//
//   zncc    p = (x - mean) / sqrt(sum (x - mean)^2 + points floor^2): unit length but for bare surfaces, where the
//   floor,
//           a grey level, keeps noise from becoming texture
//   census  p_j = s_j / sqrt(points - 1), s_j = -1 where point j is darker than the middle one, 1 where it is brighter,
//           linear in between over half a grey level to both sides: a jump there would be decided by rounding
//
// Two views differ by D_ik = |p_i - p_k|^2 / 2: 1 - ZNCC, or twice the share of bits that differ. With S the sum of all
// p, q_k = |p_k|^2 and Q their sum, nothing needs the pairs:
//
//   C_k = sum over i != k of D_ik / (n - 1) = (Q + n q_k - 2 p_k S) / (2 (n - 1))
//   sum over pairs of w_i w_k D_ik = (sum w  sum w q - |sum w p|^2) / 2
//
// so that every aggregation of sweep/view_costs.h costs n patches, not n^2.
#pragma once

#include "sweep/sweep_problem.h"
#include "sweep/view_costs.h"

namespace skysweep::sweep {

constexpr double kPatchFloor = 1;      // grey levels
constexpr double kCensusRamp = 0.5;    // grey levels
constexpr double kPatchCostGrey = 20;  // of D = 1: what normalised luminance that has nothing in common costs, nearly
constexpr int kMostPatchReach = 8;     // cells from the middle of a patch to its border at the largest window level

// Cells from the middle of the patch at the largest window level to its border.
constexpr int patch_reach(const SweepOptions& options) {
  return options.patch_radius_cells << options.window_level_max;
}

// Leaves the views that show every cell within patch_reach, at the height of `point`.
void keep_showing_patch(const SweepProblem& problem, Vec3d point, ViewSamples& samples);

// The matching cost of the point (zncc or census) from the views of `samples`: at window level w the patch's points are
// 2^w cells apart, sampled at that mipmap level; D is the mean over the levels. Aggregated as options.aggregation says,
// times kPatchCostGrey, plus few_views_penalty / n; infinity with fewer than min_views views.
double patch_cost(const SweepProblem& problem, Vec3d point, const ViewSamples& samples);

}  // namespace skysweep::sweep
