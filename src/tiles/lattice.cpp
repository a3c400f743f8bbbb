// SPDX-License-Identifier: Apache-2.0
#include "tiles/lattice.h"

#include <cmath>
#include <cstdint>

#include "core/check.h"

namespace skysweep::tiles {

namespace {

constexpr int kMaxIndex = (1 << 28) - 1;  // what TileKey packs

}  // namespace

// Integers are multiplied first, so that the corner is cell_m rounded once, the same from every side: the eastern edge
// of a tile is the western edge of the next one, bit for bit.
Vec2d Lattice::south_west_corner(TileKey key) const {
  SKY_CHECK(!key.is_top());
  const std::int64_t cells = static_cast<std::int64_t>(tile_cells) << key.level;
  return {static_cast<double>(key.x * cells) * cell_m, static_cast<double>(key.y * cells) * cell_m};
}

Vec2d Lattice::north_west_corner(TileKey key) const { return south_west_corner({key.level, key.x, key.y + 1}); }

Box2d Lattice::extent(TileKey key) const {
  return {south_west_corner(key), south_west_corner({key.level, key.x + 1, key.y + 1})};
}

int Lattice::index_at(int level, double coordinate) const {
  const double estimate = std::floor(coordinate / tile_size_m(level));
  SKY_CHECK_LE(std::abs(estimate), static_cast<double>(kMaxIndex));
  // The quotient may be rounded across a border; the corners decide, so that every tile owns its own south-west corner.
  const auto border = [&](int index) { return south_west_corner({level, index, 0}).x; };
  int index = static_cast<int>(estimate);
  while (coordinate < border(index)) --index;
  while (coordinate >= border(index + 1)) ++index;
  return index;
}

LevelPlan plan_levels(int min_x, int min_y, int max_x, int max_y) {
  SKY_CHECK_LE(min_x, max_x);
  SKY_CHECK_LE(min_y, max_y);
  LevelPlan plan;
  while ((max_x >> plan.highest_regular_level) - (min_x >> plan.highest_regular_level) > 1 ||
         (max_y >> plan.highest_regular_level) - (min_y >> plan.highest_regular_level) > 1)
    ++plan.highest_regular_level;
  const int level = plan.highest_regular_level;
  plan.top_south_west = {level, min_x >> level, min_y >> level};
  return plan;
}

}  // namespace skysweep::tiles
