// SPDX-License-Identifier: Apache-2.0
// Values of cells and their means over 2 x 2, 4 x 4 ... cells, sampled between cell centres: what a pixel that covers
// many cells shows. Unknown cells take no part.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/array2d.h"
#include "core/color.h"
#include "core/vec.h"

namespace skysweep::render {

inline bool is_known(float v) { return std::isfinite(v); }
inline bool is_known(Rgba8 v) { return v.a != 0; }
inline Vec3d as_vector(float v) { return {v, 0, 0}; }
inline Vec3d as_vector(Rgba8 v) { return {1. * v.r, 1. * v.g, 1. * v.b}; }
inline void assign(float& to, Vec3d v) { to = static_cast<float>(v.x); }
inline void assign(Rgba8& to, Vec3d v) {
  const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0, 255.0))); };
  to = {byte(v.x), byte(v.y), byte(v.z), 255};
}

template <typename T>
class MeanPyramid {
 public:
  MeanPyramid(Array2d<T> finest, T unknown) : unknown_(unknown) {
    levels_.push_back(std::move(finest));
    while (levels_.back().width() > 1 && levels_.back().height() > 1) levels_.push_back(coarser(levels_.back()));
  }

  const Array2d<T>& finest() const { return levels_.front(); }
  int levels() const { return static_cast<int>(levels_.size()); }

  // At a place in cells of the finest level from the north-west corner; `level` may lie between two levels. Of a
  // height only x counts, of a colour x, y, z are red, green, blue. Nothing where all cells around are unknown.
  std::optional<Vec3d> at(Vec2d place, double level) const {
    const double clamped = std::clamp(level, 0.0, levels() - 1.0);
    const int low = static_cast<int>(clamped);
    const std::optional<Vec3d> fine = at_level(place, low);
    if (clamped == low || !fine) return fine;
    const std::optional<Vec3d> coarse = at_level(place, low + 1);
    const double share = clamped - low;
    return coarse ? (1 - share) * *fine + share * *coarse : fine;
  }

 private:
  Array2d<T> coarser(const Array2d<T>& finer) const {
    Array2d<T> out((finer.width() + 1) / 2, (finer.height() + 1) / 2, unknown_);
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        Vec3d sum;
        int count = 0;
        for (int v = 2 * y; v < std::min(2 * y + 2, finer.height()); ++v)
          for (int u = 2 * x; u < std::min(2 * x + 2, finer.width()); ++u)
            if (is_known(finer(u, v))) sum = sum + as_vector(finer(u, v)), ++count;
        if (count > 0) assign(out(x, y), (1.0 / count) * sum);
      }
    return out;
  }

  std::optional<Vec3d> at_level(Vec2d place, int level) const {
    const Array2d<T>& cells = levels_[static_cast<std::size_t>(level)];
    const double scale = 1.0 / (1 << level);
    const double u = std::clamp(place.x * scale - 0.5, 0.0, cells.width() - 1.0);
    const double v = std::clamp(place.y * scale - 0.5, 0.0, cells.height() - 1.0);
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    Vec3d sum;
    double weights = 0;
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx) {
        const double weight = (dx ? u - x : 1 - u + x) * (dy ? v - y : 1 - v + y);
        if (weight <= 0 || !is_known(cells(x + dx, y + dy))) continue;
        sum = sum + weight * as_vector(cells(x + dx, y + dy));
        weights += weight;
      }
    if (weights <= 0) return std::nullopt;
    return (1 / weights) * sum;
  }

  T unknown_;
  std::vector<Array2d<T>> levels_;
};

}  // namespace skysweep::render
