// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace skysweep::report {

// Bytes as text for data URIs (RFC 4648, section 4, padded).
std::string base64(std::string_view bytes);

}  // namespace skysweep::report
