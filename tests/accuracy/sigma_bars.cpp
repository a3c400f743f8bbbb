// SPDX-License-Identifier: Apache-2.0
#include "accuracy/sigma_bars.h"

#include <algorithm>

namespace skysweep::accuracy {
namespace {

struct Bar {
  double lowest, highest;
  double miss(double share) const { return std::max({0.0, lowest - share, share - highest}); }
};
constexpr Bar kAll68{0.63, 0.73}, kAll95{0.92, 0.97}, kPart68{0.55, 0.80}, kPart95{0.88, 0.99};

}  // namespace

std::map<std::string, double> sigma_misses(const report::SigmaQuality& quality) {
  std::map<std::string, double> out = {{"sigma_68_miss", kAll68.miss(quality.overall.within_68)},
                                       {"sigma_95_miss", kAll95.miss(quality.overall.within_95)},
                                       {"sigma_tenths_68_miss", 0},
                                       {"sigma_tenths_95_miss", 0}};
  for (const report::Coverage& tenth : quality.deciles) {
    out["sigma_tenths_68_miss"] = std::max(out["sigma_tenths_68_miss"], kPart68.miss(tenth.within_68));
    out["sigma_tenths_95_miss"] = std::max(out["sigma_tenths_95_miss"], kPart95.miss(tenth.within_95));
  }
  for (const report::ClassCoverage& one : quality.classes) {
    const bool is_judged = one.name == "ground" || one.name == "roof" || one.name == "tree";
    if (!is_judged || one.coverage.count < kFewestJudged) continue;
    out["sigma_" + one.name + "_68_miss"] = kPart68.miss(one.coverage.within_68);
    out["sigma_" + one.name + "_95_miss"] = kPart95.miss(one.coverage.within_95);
  }
  return out;
}

}  // namespace skysweep::accuracy
