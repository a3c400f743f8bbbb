// SPDX-License-Identifier: Apache-2.0
#include "accuracy/expectations.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace skysweep::accuracy {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

Case& case_of(std::vector<Case>& cases, const std::string& scene, const std::string& preset) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.scene == scene && c.preset == preset; });
  return found != cases.end() ? *found : cases.emplace_back(Case{scene, preset, {}});
}

}  // namespace

std::vector<Case> read_expectations(const std::filesystem::path& csv) {
  std::ifstream file(csv);
  std::vector<Case> cases;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    if (++number == 1) continue;  // names of the columns
    const std::vector<std::string> f = fields_of(line);
    if (f.size() != 6 || (f[5] != "higher" && f[5] != "lower"))
      throw std::runtime_error(csv.string() + ":" + std::to_string(number) + ": cannot be read");
    case_of(cases, f[0], f[1]).expectations.push_back({f[2], std::stod(f[3]), std::stod(f[4]), f[5] == "higher"});
  }
  if (cases.empty()) throw std::runtime_error(csv.string() + " holds nothing");
  return cases;
}

}  // namespace skysweep::accuracy
