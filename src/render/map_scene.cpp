// SPDX-License-Identifier: Apache-2.0
#include "render/map_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace skysweep::render {
namespace {

constexpr double kOutlierShare = 0.002;  // of the heights, at either end, that do not count for bounds

}  // namespace

MapScene::MapScene(MapWindow window, double exaggeration)
    : map_level_(window.level),
      exaggeration_(exaggeration),
      sigma_m_(std::move(window.sigma_m)),
      colors_(std::move(window.color), Rgba8{}) {
  HeightField field = make_height_field(window.north_west_m, window.cell_m, std::move(window.height_m));
  true_bounds_ = drawn_bounds_ = bounds(field, kOutlierShare);
  base_m_ = true_bounds_.min.z;
  drawn_bounds_.max.z = base_m_ + exaggeration * (true_bounds_.max.z - base_m_);
  if (exaggeration != 1) field = exaggerated(std::move(field), exaggeration, base_m_);
  heights_.emplace(field.height_m, std::nanf(""));
  field_ = std::make_shared<const HeightField>(std::move(field));
}

Vec2d MapScene::cells(Vec3d place) const {
  const Vec3d p = field_->cells_from_map(place);
  return {p.x, p.y};
}

double MapScene::true_height_m(Vec3d place) const { return base_m_ + (place.z - base_m_) / exaggeration_; }

bool MapScene::is_hole(Vec3d place) const {
  const Vec2d c = cells(place);
  const int x = static_cast<int>(std::floor(c.x)), y = static_cast<int>(std::floor(c.y));
  return field_->kind.contains(x, y) && field_->kind(x, y) == CellKind::hole;
}

std::optional<Vec3d> MapScene::color(Vec3d place, double level) const { return colors_.at(cells(place), level); }

std::optional<double> MapScene::sigma_m(Vec3d place) const {
  const Vec2d c = cells(place);
  const int x = std::clamp(static_cast<int>(std::floor(c.x)), 0, sigma_m_.width() - 1);
  const int y = std::clamp(static_cast<int>(std::floor(c.y)), 0, sigma_m_.height() - 1);
  if (!std::isfinite(sigma_m_(x, y))) return std::nullopt;
  return sigma_m_(x, y);
}

Vec3d MapScene::normal_with(Vec3d place, double level, double factor) const {
  const Vec2d c = cells(place);
  const double reach = std::exp2(std::max(0.0, level));  // cells
  const auto height = [&](double dx, double dy) {
    const std::optional<Vec3d> h = heights_->at({c.x + dx, c.y + dy}, level);
    return factor * (h ? h->x : place.z);
  };
  const double run = 2 * reach * field_->cell_m;
  const double east = (height(reach, 0) - height(-reach, 0)) / run;
  const double south = (height(0, reach) - height(0, -reach)) / run;
  return normalized(Vec3d{-east, south, 1});
}

Vec3d MapScene::normal(Vec3d place, double level) const { return normal_with(place, level, 1); }

Vec3d MapScene::true_normal(Vec3d place, double level) const { return normal_with(place, level, 1 / exaggeration_); }

double MapScene::usual_largest_sigma_m() const {
  std::vector<float> known;
  for (const float s : sigma_m_)
    if (std::isfinite(s)) known.push_back(s);
  if (known.empty()) return 0;
  const auto at = known.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(known.size() - 1));
  std::nth_element(known.begin(), at, known.end());
  return *at;
}

}  // namespace skysweep::render
