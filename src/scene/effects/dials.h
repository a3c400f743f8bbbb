// SPDX-License-Identifier: Apache-2.0
// The dials of an effect as the scene file has them: each module lists its own, reading and scene.json follow.
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/vec.h"
#include "settings/toml_table.h"

namespace skysweep::scene {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kAboveZero = 1e-9;  // the lower limit of what has to be above zero

struct Dial {
  std::string key;
  std::variant<double*, Vec3d*> value;  // a number or a colour
  double low = 0, high = kNoLimit;
  bool required = false;  // the strength of the effect, which has no default
};

// Throws Error(usage) naming file, line and key: a value outside its limits, a required dial that is missing.
void read_dials(const settings::TomlTable& table, const std::string& effect, const std::vector<Dial>& dials);

}  // namespace skysweep::scene
