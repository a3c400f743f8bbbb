// SPDX-License-Identifier: Apache-2.0
// Casts rays at a height field: the scalar double-precision reference, and what draws on machines without OpenGL. Every
// cell on the way of a ray is visited in order, by its exact borders, unless a square of the hierarchy rules it out
// (METHODS 5; after Feldmann 2013, who steps through maxima only: with minima, too, the surface is a sheet that can be
// seen from below, and a camera under ground sees what is there).
//
// No cracks: along a ray it is known on which side of the surface it is. Whenever that side changes between two
// neighbouring elements, the border between them is hit; with boxes this is what a wall is, and between patches it
// catches what rounding might let through.
#pragma once

#include <cstdint>
#include <memory>

#include "render/height_field.h"
#include "render/height_hierarchy.h"
#include "render/ray.h"

namespace skysweep::render {

struct TraceOptions {
  PixelSize pixel;            // squares of elements smaller than this are not looked into; 0: down to the surface
  bool use_hierarchy = true;  // false: every element on the way is looked at (for measuring what it buys)
};

class RayCaster {
 public:
  // Keeps the field, which must hold at least one cell.
  RayCaster(std::shared_ptr<const HeightField> field, SurfaceForm form);

  const HeightField& field() const { return *field_; }
  const HeightHierarchy& hierarchy() const { return hierarchy_; }
  SurfaceForm form() const { return form_; }

  // The first point of the surface along the ray, beyond its origin. `steps`, if given, is raised by the number of
  // squares and elements looked at. Safe for several threads.
  Hit first_hit(const Ray& ray, const TraceOptions& options = {}, std::int64_t* steps = nullptr) const;

 private:
  std::shared_ptr<const HeightField> field_;
  SurfaceForm form_;
  HeightHierarchy hierarchy_;
};

}  // namespace skysweep::render
