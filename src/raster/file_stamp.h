// SPDX-License-Identifier: Apache-2.0
// A quick look at a file: has it been touched since the last look?
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skysweep::raster {

// Size, times of the last change of its bytes and of its entry (nanoseconds), and number of its entry, as text. Two
// stamps of a path are compared for equality only, so that clocks may run backwards; a program that sets the time of
// change back still moves the time of the entry. Nothing if there is no such file.
std::optional<std::string> file_stamp(const std::filesystem::path& path);

// The same, but empty if the file was changed so recently that a second change could bear the same times (two seconds:
// what the coarsest file systems tell apart), or in the future of this machine's clock.
std::string settled_file_stamp(const std::filesystem::path& path);

}  // namespace skysweep::raster
