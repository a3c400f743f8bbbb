// SPDX-License-Identifier: Apache-2.0
#include "sweep/match_result.h"

#include <limits>

namespace skysweep::sweep {

MatchResult::MatchResult(int width, int height)
    : plane(width, height, 0),
      cost(width, height, std::numeric_limits<float>::infinity()),
      cost_below(width, height, std::numeric_limits<float>::infinity()),
      cost_above(width, height, std::numeric_limits<float>::infinity()),
      mean_cost(width, height, std::numeric_limits<float>::infinity()),
      view_count(width, height, 0) {}

}  // namespace skysweep::sweep
