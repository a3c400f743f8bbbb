// SPDX-License-Identifier: Apache-2.0
// Little-endian values from a binary file, never beyond its end: whatever a damaged file claims, no read and no
// allocation exceeds what it holds.
#pragma once

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <type_traits>

namespace skysweep::formats {

static_assert(std::endian::native == std::endian::little, "COLMAP's binary files are little-endian");

class BinaryReader {
 public:
  // Throws Error(bad_input) if the file cannot be opened.
  explicit BinaryReader(const std::string& path);

  template <typename T>
  T read() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    read_bytes(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  }
  // A count of records of at least `least_bytes` each; throws if the rest of the file cannot hold as many.
  std::uint64_t read_count(std::uint64_t least_bytes, const char* what);
  // Text up to a zero byte.
  std::string read_name();
  void skip(std::uint64_t count, std::uint64_t bytes_each);
  // Throws unless all of the file has been read.
  void require_end() const;

  // What is being read ("image 3"), for messages.
  void set_record(std::string record) { record_ = std::move(record); }
  // "path: image 3"
  std::string where() const;

 private:
  void read_bytes(char* to, std::uint64_t bytes);
  [[noreturn]] void truncated() const;

  std::string path_;
  std::string record_;
  std::ifstream file_;
  std::uint64_t left_ = 0;  // bytes
};

}  // namespace skysweep::formats
