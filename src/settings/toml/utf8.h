// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skysweep::settings {

// Whether `text` is well-formed UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing above U+10FFFF.
bool is_utf8(const std::string& text);

}  // namespace skysweep::settings
