// SPDX-License-Identifier: Apache-2.0
#include "raster/file_stamp.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>

namespace skysweep::raster {
namespace {

constexpr long long kSettledSeconds = 2;

std::optional<struct stat> look_at(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return found;
}

std::string text_of(const timespec& time) { return std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec); }

std::string text_of(const struct stat& s) {
  return std::to_string(s.st_size) + " " + text_of(s.st_mtim) + " " + text_of(s.st_ctim) + " " +
         std::to_string(s.st_ino);
}

}  // namespace

std::optional<std::string> file_stamp(const std::filesystem::path& path) {
  const std::optional<struct stat> found = look_at(path);
  return found ? std::optional(text_of(*found)) : std::nullopt;
}

std::string settled_file_stamp(const std::filesystem::path& path) {
  const std::optional<struct stat> found = look_at(path);
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  if (!found || std::max(found->st_mtim.tv_sec, found->st_ctim.tv_sec) + kSettledSeconds >= now.tv_sec) return {};
  return text_of(*found);
}

}  // namespace skysweep::raster
