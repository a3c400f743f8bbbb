// SPDX-License-Identifier: Apache-2.0
// What is cast at the surface and what comes back.
#pragma once

#include <limits>

#include "core/vec.h"

namespace skysweep::render {

struct Ray {
  Vec3d origin;     // map coordinates, metres
  Vec3d direction;  // unit vector: distances along the ray are metres
};

inline Vec3d along(const Ray& ray, double distance_m) { return ray.origin + distance_m * ray.direction; }

// The side of a pixel in the world at a distance along its ray: fixed_m + per_metre * distance. Both 0: a point.
struct PixelSize {
  double fixed_m = 0;
  double per_metre = 0;
  double at(double distance_m) const { return fixed_m + per_metre * distance_m; }
};

// What of the surface was hit.
enum class Face {
  top,     // an element's own surface
  wall_x,  // the wall between two boxes side by side, facing east or west
  wall_y,  // ... facing north or south
  square,  // a square of elements no larger than a pixel, as one box: the level-of-detail stop
};

struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();  // infinite: nothing was hit
  int level = 0;                                                // of the hierarchy: 0 is the element itself
  Face face = Face::top;
  bool from_below = false;  // the ray came from under the surface
  bool any() const { return distance_m < std::numeric_limits<double>::infinity(); }
};

}  // namespace skysweep::render
