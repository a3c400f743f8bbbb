// SPDX-License-Identifier: Apache-2.0
// Where a ray first meets a bilinear patch, exactly: along a straight line over the unit square the height of the patch
// is a quadratic.
#pragma once

#include <cmath>
#include <optional>

#include "core/vec.h"

namespace skysweep::render {

// Heights at the corners of the unit square: h00 at (0, 0), h10 at (1, 0), h01 at (0, 1), h11 at (1, 1).
struct BilinearPatch {
  double h00, h10, h01, h11;

  double twist() const { return h00 - h10 - h01 + h11; }
  double at(Vec2d p) const { return h00 + p.x * (h10 - h00) + p.y * (h01 - h00) + p.x * p.y * twist(); }
};

// The smallest q in [0, 1] at which c + b q + a q^2 is zero, if its sign at 0 differs from that somewhere later;
// zero counts as positive, which is what a height at or above the surface is. c is its value at 0.
inline std::optional<double> first_sign_change(double a, double b, double c) {
  const bool above = c >= 0;
  const double end = a + b + c;
  if ((end >= 0) == above) {  // both ends on one side: only a vertex in between can lie on the other
    if (!(a != 0)) return std::nullopt;
    const double vertex = -b / (2 * a);
    if (!(vertex > 0 && vertex < 1) || (c + vertex * (b + vertex * a) >= 0) == above) return std::nullopt;
  }
  // Citardauq form: no cancellation, and a = 0 is no special case.
  const double root = std::sqrt(std::fmax(0.0, b * b - 4 * a * c));
  const double sum = -0.5 * (b + std::copysign(root, b));
  double first = 2;
  for (const double q : {a != 0 ? sum / a : 2.0, sum != 0 ? c / sum : 0.0})
    if (q >= 0 && q < first) first = q;
  return std::fmin(first, 1.0);
}

// The ray runs straight from (from, z_from) to (to, z_to) over the square. The share of this way at which it changes
// from above the patch to below it or back.
inline std::optional<double> first_crossing(const BilinearPatch& patch, Vec2d from, double z_from, Vec2d to,
                                            double z_to) {
  const double c = z_from - patch.at(from);
  const double end = z_to - patch.at(to);
  const double a = -patch.twist() * (to.x - from.x) * (to.y - from.y);
  return first_sign_change(a, end - c - a, c);
}

}  // namespace skysweep::render
