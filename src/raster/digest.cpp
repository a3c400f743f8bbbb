// SPDX-License-Identifier: Apache-2.0
#include "raster/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "core/error.h"

namespace skysweep::raster {

struct Digest::State {
  XXH3_state_t xxh;
};

Digest::Digest() : state_(std::make_unique<State>()) { XXH3_128bits_reset(&state_->xxh); }
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

Digest& Digest::add_bytes(std::string_view bytes) {
  if (!bytes.empty()) XXH3_128bits_update(&state_->xxh, bytes.data(), bytes.size());
  return *this;
}

Digest& Digest::add_field(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  char length[8];  // little-endian on every machine
  for (int i = 0; i < 8; ++i) length[i] = static_cast<char>(size >> (8 * i));
  return add_bytes({length, sizeof(length)}).add_bytes(bytes);
}

std::string Digest::hex() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&state_->xxh));
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::string digest_of_bytes(std::string_view bytes) { return Digest().add_bytes(bytes).hex(); }

std::string digest_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) throw bad_input("cannot read " + path.string());
  Digest digest;
  std::vector<char> buffer(1 << 20);
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    digest.add_bytes({buffer.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) throw bad_input("reading " + path.string() + " failed half-way: check the disk or copy the file again");
  return digest.hex();
}

}  // namespace skysweep::raster
