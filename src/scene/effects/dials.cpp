// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/dials.h"

#include <optional>
#include <sstream>

#include "core/error.h"

namespace skysweep::scene {
namespace {

void require_within(const Dial& dial, double value, const std::string& where) {
  if (value >= dial.low && value <= dial.high) return;
  std::ostringstream text;
  text << where << " must ";
  if (dial.low == kAboveZero && dial.high == kNoLimit)
    text << "be above 0";
  else if (dial.low == kAboveZero)
    text << "be above 0 and at most " << dial.high;
  else if (dial.high == kNoLimit)
    text << "be at least " << dial.low;
  else
    text << "lie between " << dial.low << " and " << dial.high;
  if (dial.required && value == 0) text << "; leave the table out for a scene without the effect";
  throw usage_error(text.str());
}

}  // namespace

void read_dials(const settings::TomlTable& table, const std::string& effect, const std::vector<Dial>& dials) {
  for (const Dial& dial : dials) {
    if (double* const* number = std::get_if<double*>(&dial.value)) {
      const std::optional<double> found = table.number(dial.key);
      if (!found && dial.required) throw usage_error(effect + " does not say how strong it is: set its " + dial.key);
      if (!found) continue;
      require_within(dial, *found, table.where(dial.key));
      **number = *found;
      continue;
    }
    const std::optional<std::vector<double>> found = table.numbers(dial.key);
    if (!found) continue;
    if (found->size() != 3) throw usage_error(table.where(dial.key) + " must be three numbers: red, green, blue");
    for (const double v : *found) require_within(dial, v, table.where(dial.key));
    *std::get<Vec3d*>(dial.value) = {(*found)[0], (*found)[1], (*found)[2]};
  }
}

}  // namespace skysweep::scene
