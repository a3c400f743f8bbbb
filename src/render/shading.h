// SPDX-License-Identifier: Apache-2.0
// The colour of a place that a ray has hit.
#pragma once

#include <optional>

#include "render/look.h"
#include "render/map_scene.h"
#include "render/ray.h"
#include "render/view_counts.h"

namespace skysweep::render {

class Shading {
 public:
  // The scene must outlive it. `counts` is needed for Look::views, and then must outlive it, too.
  Shading(const MapScene& scene, const LookOptions& options, const View& view, const ViewCounts* counts);

  // 0 to 255. `pixel`: where in the picture, for the hatching of holes.
  Vec3d color(const Ray& ray, const Hit& hit, bool in_shadow, Vec2d pixel) const;
  Vec3d background() const;
  Vec3d normal(const Ray& ray, const Hit& hit) const;

  // From a hit towards the sun, lifted off the surface; nothing where the surface faces away from it.
  std::optional<Ray> shadow_ray(const Ray& ray, const Hit& hit) const;

  // None for looks that show no numbers.
  const std::optional<Scale>& scale() const { return scale_; }

 private:
  double level_at(const Hit& hit) const;
  Vec3d base_color(Vec3d place, const Hit& hit) const;
  std::optional<double> number(Vec3d place, const Hit& hit) const;

  const MapScene& scene_;
  LookOptions options_;
  PixelSize pixel_;
  const ViewCounts* counts_;
  Vec3d sun_;
  std::optional<Scale> scale_;
};

}  // namespace skysweep::render
