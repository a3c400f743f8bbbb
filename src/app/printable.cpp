// SPDX-License-Identifier: Apache-2.0
#include "app/printable.h"

#include <array>
#include <cstdio>

namespace skysweep::app {

std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (code < 0x20 || code == 0x7f) {
      std::array<char, 8> hex{};
      std::snprintf(hex.data(), hex.size(), "\\x%02x", static_cast<unsigned>(code));
      out += hex.data();
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace skysweep::app
