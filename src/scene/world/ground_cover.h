// SPDX-License-Identifier: Apache-2.0
// What covers the ground where it is not the plain procedural green or a town: a texture that the scene names, bare
// rock and sand on shaped ground, and water.
#pragma once

#include <array>

#include "core/array2d.h"
#include "core/color.h"
#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/ground.h"
#include "scene/world/linear_rgb.h"

namespace skysweep::scene {

class GroundCover {
 public:
  // Reads the image of a texture of kind image: throws Error naming the file, if it is missing or no orthophoto, and
  // Error(usage) if it does not cover the mapped area. `ground` must outlive the object.
  GroundCover(const Scene& scene, const Ground& ground);

  // Whether a texture takes the place of the procedural ground, and its reflectance.
  bool replaces() const { return kind_ != GroundTexture::natural; }
  LinearRgb replacement(Vec2d p) const;

  // Whether the ground has a shape of its own, which shows: rock on what is steep, sand at the water's edge, and
  // broad differences of tone.
  bool bares() const { return bares_; }
  LinearRgb bared(LinearRgb cover, Vec3d position, Vec3d normal) const;

  // Of a water surface: what its depth lets through of the bed, and its own colour.
  LinearRgb water(Vec3d position) const;

 private:
  LinearRgb tile(Vec2d p) const;
  LinearRgb checker(Vec2d p) const;
  LinearRgb image(Vec2d p) const;
  LinearRgb rock(Vec3d position, Vec3d normal) const;
  // Detail at all sizes from the finest to `coarsest_m`, about 0, in [-1, 1].
  float detail(Vec2d p, double coarsest_m, std::uint32_t seed) const;

  const Ground& ground_;
  GroundTexture kind_;
  bool bares_;
  double dug_below_m_;  // ground lower than this has been dug: it is bare gravel
  double period_m_, finest_m_;
  float contrast_;
  std::uint32_t seed_;
  Array2d<Rgba8> image_;
  Vec2d image_corner_;  // north-west, in the scene's frame
  double image_cell_m_ = 1;
  std::array<float, 256> linear_{};  // of an sRGB grey level
};

}  // namespace skysweep::scene
