// SPDX-License-Identifier: Apache-2.0
#include "formats/text/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"

namespace skysweep::formats {

void write_text_file(const std::string& path, const std::string& content) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << content;
  file.close();
  if (!file) throw failure(path + ": cannot be written (" + std::strerror(errno) + ").");
}

}  // namespace skysweep::formats
