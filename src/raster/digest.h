// SPDX-License-Identifier: Apache-2.0
// Digests that tell whether two inputs are the same bytes: photographs, poses, settings, tiles. XXH3 with 128 bits:
// made for speed, safe against chance, not against an adversary.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace skysweep::raster {

// Takes its input piece by piece. Fields carry their length, so that ("ab", "c") and ("a", "bc") differ.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  Digest& add_bytes(std::string_view bytes);
  Digest& add_field(std::string_view bytes);

  // 32 lower-case hexadecimal digits of everything added so far; more may be added afterwards.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string digest_of_bytes(std::string_view bytes);

// Throws Error(bad_input) naming the file if it cannot be read.
std::string digest_of_file(const std::filesystem::path& path);

}  // namespace skysweep::raster
