// SPDX-License-Identifier: Apache-2.0
// What no hard case may break: every cell either claims finite values or says that it knows nothing, whatever the
// number of threads; and how well the claimed heights are met.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "sweep/plane_sweep.h"

namespace skysweep::hard {

template <typename T>
bool same_bits(const Array2d<T>& a, const Array2d<T>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// No infinity, no NaN beside a value unless it is filled, no colour without a view, heights within the planes searched.
inline void expect_sound(const sweep::SweepProblem& problem, const sweep::SweepResult& r) {
  int unsound = 0;
  for (int y = 0; y < problem.grid.height; ++y) {
    for (int x = 0; x < problem.grid.width; ++x) {
      const float z = r.height_m(x, y), sigma = r.sigma_m(x, y);
      const bool nothing = std::isnan(z) && std::isnan(sigma);
      const sweep::PlaneRange planes = problem.planes_at(x, y).hull();
      // One plane of freedom: single precision rounds heights of several kilometres.
      const bool sigma_fits = r.filled(x, y) != 0 ? std::isnan(sigma) : std::isfinite(sigma) && sigma > 0;
      const bool something = std::isfinite(z) && sigma_fits && z >= (planes.first - 1) * problem.dz_m &&
                             z <= (planes.last + 1) * problem.dz_m;
      const bool color = r.color(x, y).a == 0 ? r.color_view(x, y) == -1
                                              : r.color(x, y).a == 255 && r.color_view(x, y) >= 0 &&
                                                    r.color_view(x, y) < static_cast<int>(problem.views.size());
      unsound += !(nothing || something) || !color;
    }
  }
  EXPECT_EQ(unsound, 0) << "cells that claim a value which is none";
}

// The sweep on one thread, proven sound and equal, bit for bit, to that on three.
inline sweep::SweepResult sweep_soundly(const sweep::SweepProblem& problem) {
  SerialExecutor serial;
  ThreadExecutor threads(3);
  sweep::SweepResult one = sweep::plane_sweep(problem, sweep::Backend::cpu, serial);
  const sweep::SweepResult three = sweep::plane_sweep(problem, sweep::Backend::cpu, threads);
  EXPECT_TRUE(same_bits(one.height_m, three.height_m) && same_bits(one.sigma_m, three.sigma_m) &&
              same_bits(one.color, three.color) && same_bits(one.view_count, three.view_count))
      << "depends on the number of threads";
  expect_sound(problem, one);
  return one;
}

struct Agreement {
  double known = 0;          // share of the cells that claim a height
  double median_error = 0;   // of those, absolute, metres; infinite when there are none
  double within = 0;         // share of those whose error is within the tolerance asked for
  double within_3sigma = 0;  // share of those whose error is within three of their own standard deviations
};

inline Agreement compare(const sweep::SweepProblem& problem, const sweep::SweepResult& result,
                         const std::function<double(double, double)>& truth, double tolerance_m) {
  std::vector<double> errors;
  Agreement out;
  for (int y = 0; y < problem.grid.height; ++y) {
    for (int x = 0; x < problem.grid.width; ++x) {
      if (std::isnan(result.height_m(x, y))) continue;
      const Vec2d cell = problem.grid.cell_center(x, y);
      const double error = std::abs(result.height_m(x, y) - truth(cell.x, cell.y));
      errors.push_back(error);
      out.within += error <= tolerance_m;
      out.within_3sigma += error <= 3 * result.sigma_m(x, y);
    }
  }
  out.known = static_cast<double>(errors.size()) / static_cast<double>(result.height_m.size());
  out.median_error = std::numeric_limits<double>::infinity();
  if (errors.empty()) return out;
  out.within /= static_cast<double>(errors.size());
  out.within_3sigma /= static_cast<double>(errors.size());
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  out.median_error = *middle;
  return out;
}

inline std::ostream& operator<<(std::ostream& out, const Agreement& a) {
  return out << "known " << a.known << ", median error " << a.median_error << " m, within tolerance " << a.within
             << ", within 3 sigma " << a.within_3sigma;
}

}  // namespace skysweep::hard
