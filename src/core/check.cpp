// SPDX-License-Identifier: Apache-2.0
#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace skysweep::detail {

void check_failed(const char* file, int line, const char* expression, const std::string& values) {
  std::fprintf(stderr, "%s:%d: this should never be false: %s%s%s\n", file, line, expression,
               values.empty() ? "" : "; ", values.c_str());
  std::abort();
}

}  // namespace skysweep::detail
