// SPDX-License-Identifier: Apache-2.0
#include "formats/colmap/binary_reader.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace skysweep::formats {
namespace {

constexpr std::size_t kLongestName = 4096;  // PATH_MAX of Linux

}  // namespace

BinaryReader::BinaryReader(const std::string& path) : path_(path) {
  std::error_code error;
  left_ = std::filesystem::file_size(path, error);
  if (error) throw bad_input(path + ": cannot be opened (" + error.message() + ").");
  file_.open(path, std::ios::binary);
  if (!file_) throw bad_input(path + ": cannot be opened (" + std::strerror(errno) + ").");
}

std::uint64_t BinaryReader::read_count(std::uint64_t least_bytes, const char* what) {
  const auto count = read<std::uint64_t>();
  if (count > left_ / least_bytes)
    throw bad_input(where() + ": claims " + std::to_string(count) + " " + what + ", but the file has room for " +
                    std::to_string(left_ / least_bytes) + " at most; it is damaged or truncated, copy it again.");
  return count;
}

std::string BinaryReader::read_name() {
  std::string name;
  for (char c = read<char>(); c != '\0'; c = read<char>()) {
    name += c;
    if (name.size() > kLongestName)
      throw bad_input(where() + ": the name does not end; the file is damaged, copy it again.");
  }
  return name;
}

void BinaryReader::skip(std::uint64_t count, std::uint64_t bytes_each) {
  if (count > left_ / bytes_each) truncated();
  file_.seekg(static_cast<std::streamoff>(count * bytes_each), std::ios::cur);
  left_ -= count * bytes_each;
}

void BinaryReader::require_end() const {
  if (left_ != 0)
    throw bad_input(path_ + ": goes on for " + std::to_string(left_) +
                    " bytes after its last record; it is damaged or of an unknown version.");
}

std::string BinaryReader::where() const { return record_.empty() ? path_ : path_ + ": " + record_; }

void BinaryReader::read_bytes(char* to, std::uint64_t bytes) {
  if (bytes > left_ || !file_.read(to, static_cast<std::streamsize>(bytes))) truncated();
  left_ -= bytes;
}

void BinaryReader::truncated() const {
  throw bad_input(where() + ": the file ends in the middle of this record; it is truncated, copy it again.");
}

}  // namespace skysweep::formats
