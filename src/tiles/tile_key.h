// SPDX-License-Identifier: Apache-2.0
// The name of a tile, unique for ever: growing the map never renames one.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace skysweep::tiles {

// Level 0 is the finest; x grows eastwards, y northwards; tile (0, 0) has its south-west corner in the world's origin.
// Printed as l3x-7y4; the one tile above all levels is `top`.
struct TileKey {
  int level = 0;
  int x = 0;
  int y = 0;

  static constexpr int kTopLevel = 63;
  static constexpr TileKey top() { return {kTopLevel, 0, 0}; }
  constexpr bool is_top() const { return level == kTopLevel; }

  // The tile one level up that covers this one: floor(n / 2), also for negatives.
  constexpr TileKey parent() const { return {level + 1, x >> 1, y >> 1}; }
  // Child in column dx (0 west, 1 east) and row dy (0 south, 1 north).
  constexpr TileKey child(int dx, int dy) const { return {level - 1, 2 * x + dx, 2 * y + dy}; }

  std::string name() const;
  static std::optional<TileKey> parse(std::string_view name);

  // 6 bits of level and 29 bits each of x and y. Precondition: |x|, |y| < 2^28.
  std::uint64_t packed() const;
  static TileKey unpacked(std::uint64_t packed);

  friend constexpr auto operator<=>(const TileKey&, const TileKey&) = default;
};

}  // namespace skysweep::tiles

template <>
struct std::hash<skysweep::tiles::TileKey> {
  std::size_t operator()(const skysweep::tiles::TileKey& key) const { return std::hash<std::uint64_t>()(key.packed()); }
};
