// SPDX-License-Identifier: Apache-2.0
// What a confidence layer must hold on scenes that it was not fitted to.
#pragma once

#include <map>
#include <string>

#include "report/sigma_quality.h"

namespace skysweep::accuracy {

// How far coverage lies outside the bars, 0 where it holds: of one sigma 63 to 73 %, of 1.96 sigma 92 to 97 % of all
// ("sigma_68_miss", "sigma_95_miss"); 55 to 80 % and 88 to 99 % of the worst tenth by sigma ("sigma_tenths_68_miss",
// ...) and of ground, roofs and trees each alone ("sigma_ground_68_miss", ...), where the scene has at least
// kFewestJudged of them.
std::map<std::string, double> sigma_misses(const report::SigmaQuality& quality);

inline constexpr int kFewestJudged = 1000;

}  // namespace skysweep::accuracy
