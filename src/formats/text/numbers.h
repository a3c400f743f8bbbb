// SPDX-License-Identifier: Apache-2.0
// Numbers in text files, independent of the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace skysweep::formats {

// The finite number that the whole of `text` spells; nothing for anything else ("", "1,5", "12m", "nan", "inf").
std::optional<double> parse_number(std::string_view text);

// The non-negative integer that the whole of `text` spells.
std::optional<std::uint64_t> parse_count(std::string_view text);

// The shortest decimal text that reads back as the same bits (17 significant digits at most).
std::string exact_text(double value);

}  // namespace skysweep::formats
