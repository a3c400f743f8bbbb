// SPDX-License-Identifier: Apache-2.0
// What a scene mapped with a preset has to reach, as tests/accuracy/expected.csv stores it: one figure a row,
//
//   scene,preset,metric,measured,tolerance,better
//
// `measured` is the figure when the row was last changed; a run fails when it is worse by more than `tolerance` in the
// direction opposite to `better` (higher or lower). Rows are only ever tightened; those of a scene stand together.
// `accuracy_test --gtest_output=json:figures.json` writes what was measured, for new rows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skysweep::accuracy {

struct Expectation {
  std::string metric;
  double measured = 0;
  double tolerance = 0;
  bool higher_is_better = false;

  double limit() const { return higher_is_better ? measured - tolerance : measured + tolerance; }
  bool met_by(double value) const { return higher_is_better ? value >= limit() : value <= limit(); }
};

struct Case {
  std::string scene;
  std::string preset;
  std::vector<Expectation> expectations;
};

// Cases in the order of the file. Throws std::runtime_error naming the line of a row that cannot be read.
std::vector<Case> read_expectations(const std::filesystem::path& csv);

}  // namespace skysweep::accuracy
