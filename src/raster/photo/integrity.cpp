// SPDX-License-Identifier: Apache-2.0
#include "raster/photo/integrity.h"

#include <cstddef>
#include <cstdint>

namespace skysweep::raster {

namespace {

std::uint8_t byte_at(std::string_view bytes, std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); }

std::uint32_t big_endian(std::string_view bytes, std::size_t i, int count) {
  std::uint32_t value = 0;
  for (int k = 0; k < count; ++k) value = value << 8 | byte_at(bytes, i + k);
  return value;
}

// Markers that stand alone, without a length: TEM and RST0-RST7, and a zero, which is no marker but a stuffed byte.
bool stands_alone(std::uint8_t marker) { return marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd7); }

}  // namespace

bool jpeg_is_complete(std::string_view bytes) {
  constexpr std::uint8_t kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda;
  if (bytes.size() < 4 || byte_at(bytes, 0) != 0xff || byte_at(bytes, 1) != kStartOfImage) return false;
  bool scan_seen = false;
  std::size_t i = 2;
  while (true) {
    // Over the rest of a scan's entropy-coded data, and over fill bytes, to the next marker.
    i = bytes.find('\xff', i);
    while (i != std::string_view::npos && i + 1 < bytes.size() && byte_at(bytes, i + 1) == 0xff) ++i;
    if (i == std::string_view::npos || i + 1 >= bytes.size()) return false;
    const std::uint8_t marker = byte_at(bytes, i + 1);
    i += 2;
    if (marker == kEndOfImage) return scan_seen;
    if (stands_alone(marker)) continue;
    if (i + 2 > bytes.size()) return false;
    scan_seen |= marker == kStartOfScan;
    i += big_endian(bytes, i, 2);
  }
}

bool png_is_complete(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kLengthTypeAndCrc = 12;
  for (std::size_t i = kSignature; i + kLengthTypeAndCrc <= bytes.size();) {
    const std::size_t length = big_endian(bytes, i, 4);
    if (bytes.substr(i + 4, 4) == "IEND") return true;
    i += kLengthTypeAndCrc + length;
  }
  return false;
}

}  // namespace skysweep::raster
