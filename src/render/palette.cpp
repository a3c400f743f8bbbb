// SPDX-License-Identifier: Apache-2.0
#include "render/palette.h"

#include <algorithm>
#include <array>

namespace skysweep::render {

Vec3d Palette::at(double share) const {
  const double position = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops_.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(position), stops_.size() - 2);
  const double t = position - static_cast<double>(low);
  return (1 - t) * stops_[low] + t * stops_[low + 1];
}

const Palette& relief_palette() {
  static const Palette palette({{86, 150, 110}, {170, 200, 130}, {235, 220, 150}, {190, 140, 100}, {250, 250, 250}});
  return palette;
}

const Palette& slope_palette() {
  static const Palette palette({{250, 250, 245}, {250, 225, 120}, {235, 120, 60}, {150, 30, 50}, {60, 10, 50}});
  return palette;
}

const Palette& confidence_palette() {
  static const Palette palette({{40, 140, 90}, {160, 205, 95}, {250, 220, 110}, {240, 130, 60}, {190, 30, 45}});
  return palette;
}

const Palette& count_palette() {
  static const Palette palette({{65, 20, 95}, {60, 85, 140}, {35, 145, 140}, {110, 205, 90}, {250, 230, 40}});
  return palette;
}

Vec3d level_color(int level) {
  static constexpr std::array<Vec3d, 8> kColors = {{{245, 245, 245},
                                                    {90, 160, 220},
                                                    {240, 170, 70},
                                                    {100, 180, 100},
                                                    {220, 90, 90},
                                                    {160, 120, 200},
                                                    {150, 110, 80},
                                                    {235, 140, 190}}};
  return kColors[static_cast<std::size_t>(level) % kColors.size()];
}

}  // namespace skysweep::render
