// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Mipmap level of a view's pyramid that stands for window level `window_level`; the coarsest there is when the pyramid
// ends before.
inline int sampling_level(const View& view, int window_level) {
  return std::min(view.base_level + window_level, view.image->levels() - 1);
}

}  // namespace skysweep::sweep
