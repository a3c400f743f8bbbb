// SPDX-License-Identifier: Apache-2.0
#include "sweep/luminance_gains.h"

#include <bit>
#include <cmath>

#include "core/check.h"
#include "sweep/exposure.h"
#include "sweep/height_range.h"

namespace skysweep::sweep {
namespace {

constexpr double kSrgbOffset = 0.055 * 255, kSrgbGamma = 2.4;

SweepProblem coarse_views(const SweepProblem& problem, const Array2d<float>& height_m) {
  SweepProblem coarse;
  coarse.grid = {height_m.width(), height_m.height(), problem.grid.cell_m * kCoarseCells,
                 problem.grid.north_west_corner};
  coarse.dz_m = problem.dz_m * kCoarseCells;
  coarse.views = problem.views;
  for (View& view : coarse.views) view.base_level += std::countr_zero(static_cast<unsigned>(kCoarseCells));
  return coarse;
}

double luminance_of(const LogGain& gain) { return 0.212671 * gain[0] + 0.715160 * gain[1] + 0.072169 * gain[2]; }

}  // namespace

bool compares_luminance(const SweepOptions& options) {
  return options.compensate_exposure && options.cost == MatchingCost::sad && options.normalization_radius_px == 0;
}

void equalize_luminance(const Array2d<float>& height_m, Executor& executor, SweepProblem& problem) {
  if (!compares_luminance(problem.options) || height_m.empty()) return;
  const SweepProblem coarse = coarse_views(problem, height_m);
  const Array2d<CellCandidates> cells = color_candidates(coarse, height_m, CoreWithMargin(coarse, 0), executor);
  const std::vector<LogGain> gains = estimate_exposures(cells, static_cast<int>(problem.views.size()), 1);
  for (std::size_t v = 0; v < gains.size(); ++v) {
    View& view = problem.views[v];
    view.gain = std::exp(-luminance_of(gains[v]) / kSrgbGamma);
    view.offset = kSrgbOffset * (view.gain - 1);
  }
}

}  // namespace skysweep::sweep
