// SPDX-License-Identifier: Apache-2.0
#include "report/evaluation.h"

namespace skysweep::report {

EdgeAccuracy edge_accuracy(const HeightDifferences& cells, double step_m, double gsd_m,
                           const Array2d<std::uint8_t>* region) {
  return {compare_edges(cells, step_m, gsd_m, region), step_displacement(cells, step_m, gsd_m, region)};
}

}  // namespace skysweep::report
