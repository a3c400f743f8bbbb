// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skysweep::formats {

// Writes `content` to the file; throws Error(failed), with the reason, if not all of it could be written.
void write_text_file(const std::string& path, const std::string& content);

}  // namespace skysweep::formats
