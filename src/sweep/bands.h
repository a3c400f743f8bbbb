// SPDX-License-Identifier: Apache-2.0
// A problem whose cost volume would be too large is swept in bands of whole block rows, each with a collar, so that
// memory is bounded whatever heights a tile spans. How it is cut depends on the problem alone.
#pragma once

#include <vector>

#include "sweep/match_result.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Block rows: [swept_first, swept_last) are swept, [core_first, core_last) are kept.
struct Band {
  int swept_first = 0, swept_last = 0;
  int core_first = 0, core_last = 0;
};

// One band with everything if its volume keeps to options.volume_limit_mib; else as few as do, at least one core row
// each.
std::vector<Band> bands_within(const SweepProblem& problem);

SweepProblem part_of(const SweepProblem& problem, const Band& band);
void copy_core(const MatchResult& part, const Band& band, MatchResult& whole);

}  // namespace skysweep::sweep
