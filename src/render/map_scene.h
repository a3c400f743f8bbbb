// SPDX-License-Identifier: Apache-2.0
// What is drawn: the surface of a window of the map and all that can be asked about a place on it.
#pragma once

#include <memory>
#include <optional>

#include "render/height_field.h"
#include "render/map_window.h"
#include "render/mean_pyramid.h"

namespace skysweep::render {

class MapScene {
 public:
  // Heights above the lowest of the window (but for a few outliers) are multiplied by `exaggeration`.
  MapScene(MapWindow window, double exaggeration);

  // With exaggerated heights: what rays are cast at.
  const std::shared_ptr<const HeightField>& field() const { return field_; }
  int map_level() const { return map_level_; }
  // Around the known surface but for outliers of height; exaggerated, or as it is.
  const Box3d& drawn_bounds() const { return drawn_bounds_; }
  const Box3d& true_bounds() const { return true_bounds_; }

  // All of these take a drawn place. `level`: how coarse, as of MeanPyramid.
  double true_height_m(Vec3d place) const;
  bool is_hole(Vec3d place) const;
  std::optional<Vec3d> color(Vec3d place, double level) const;  // 0 to 255; nothing where none is known
  std::optional<double> sigma_m(Vec3d place) const;
  // Upwards, of the drawn surface or of the true one, over about two cells of the level.
  Vec3d normal(Vec3d place, double level) const;
  Vec3d true_normal(Vec3d place, double level) const;

  // All but a tenth of the known standard deviations are smaller; 0 if none is known.
  double usual_largest_sigma_m() const;

 private:
  Vec2d cells(Vec3d place) const;
  Vec3d normal_with(Vec3d place, double level, double factor) const;

  int map_level_;
  double exaggeration_, base_m_ = 0;
  Box3d true_bounds_, drawn_bounds_;
  Array2d<float> sigma_m_;
  MeanPyramid<Rgba8> colors_;
  std::shared_ptr<const HeightField> field_;
  std::optional<MeanPyramid<float>> heights_;  // exaggerated, with stand-ins
};

}  // namespace skysweep::render
