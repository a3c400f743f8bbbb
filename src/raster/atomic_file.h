// SPDX-License-Identifier: Apache-2.0
// Files that are whole or absent: written under a temporary name in the same folder, flushed to the disk, renamed, and
// the folder flushed. A reader never sees half a file; a crash leaves at most a temporary file behind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace skysweep::raster {

// Calls `write` with a temporary path beside `path` (same extension), then puts what it wrote in the place of `path`.
// If `write` throws, the temporary file is removed and `path` is as before. Makes missing folders.
// Throws Error(failed) naming `path`.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

// The same for bytes in memory.
void write_bytes_atomically(const std::filesystem::path& path, std::string_view bytes);

// Removes what crashed runs left behind in `folder` and below it. Call it only while nobody else writes there.
void remove_temporary_files(const std::filesystem::path& folder);

// Free bytes on the file system that holds `path` (or the nearest parent that exists).
std::uint64_t free_disk_space(const std::filesystem::path& path);

// Throws Error(failed) with a sentence unless files can be made in `folder`; makes the folder.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace skysweep::raster
