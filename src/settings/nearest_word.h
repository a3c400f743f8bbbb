// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...?": the word somebody most likely wanted to type.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skysweep::settings {

// The fewest insertions, deletions, replacements and swaps of neighbouring characters that turn `a` into `b` (optimal
// string alignment distance).
int edit_distance(const std::string& a, const std::string& b);

// The candidate nearest to `word`, the first of equals; nothing when none is alike (more than a third would change).
std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace skysweep::settings
