// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_key.h"

#include <charconv>

#include "core/check.h"

namespace skysweep::tiles {

namespace {

constexpr int kIndexBits = 29;
constexpr std::uint64_t kIndexMask = (1ull << kIndexBits) - 1;
constexpr int kIndexOffset = 1 << (kIndexBits - 1);  // makes the packed order the order of the keys

// Takes a decimal integer off the front of `text`, written the one way in which name() writes it.
std::optional<int> take_integer(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  const std::string_view digits = text.substr(0, end - text.data());
  if (digits != std::to_string(value)) return std::nullopt;  // -0, 007
  text.remove_prefix(digits.size());
  return value;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::string TileKey::name() const {
  if (is_top()) return "top";
  return "l" + std::to_string(level) + "x" + std::to_string(x) + "y" + std::to_string(y);
}

std::optional<TileKey> TileKey::parse(std::string_view name) {
  if (name == "top") return top();
  if (!take(name, 'l')) return std::nullopt;
  const std::optional<int> level = take_integer(name);
  if (!level || *level < 0 || *level >= kTopLevel || !take(name, 'x')) return std::nullopt;
  const std::optional<int> x = take_integer(name);
  if (!x || !take(name, 'y')) return std::nullopt;
  const std::optional<int> y = take_integer(name);
  if (!y || !name.empty()) return std::nullopt;
  return TileKey{*level, *x, *y};
}

std::uint64_t TileKey::packed() const {
  SKY_CHECK(level >= 0 && level <= kTopLevel);
  SKY_CHECK(x > -kIndexOffset && x < kIndexOffset && y > -kIndexOffset && y < kIndexOffset);
  const auto bits = [](int index) { return static_cast<std::uint64_t>(index + kIndexOffset); };
  return static_cast<std::uint64_t>(level) << (2 * kIndexBits) | bits(x) << kIndexBits | bits(y);
}

TileKey TileKey::unpacked(std::uint64_t packed) {
  const auto index = [](std::uint64_t bits) { return static_cast<int>(bits & kIndexMask) - kIndexOffset; };
  return {static_cast<int>(packed >> (2 * kIndexBits)), index(packed >> kIndexBits), index(packed)};
}

}  // namespace skysweep::tiles
