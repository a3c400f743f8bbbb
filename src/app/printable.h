// SPDX-License-Identifier: Apache-2.0
// Texts that hold names of files, which may hold anything: a line break in a name must not look like a line of ours,
// nor an escape sequence reach a terminal.
#pragma once

#include <string>

namespace skysweep::app {

// Control characters as \n, \t or \x1b; everything else, UTF-8 too, as it is.
std::string printable(const std::string& text);

}  // namespace skysweep::app
