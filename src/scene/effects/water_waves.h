// SPDX-License-Identifier: Apache-2.0
// How a water surface is roughened by the wind: waves long enough to be seen one by one, and the statistics of the
// others.
//
// The mean square slope is 0.003 + 0.00512 U, U the wind in m/s, and slopes are normally distributed (Cox & Munk 1954).
// The part that grows with the wind is spread evenly over the logarithm of the wavelength (Phillips 1977: saturation
// range), from ripples of 1.7 cm, below which surface tension rules, to the longest waves. Of these, the ones longer
// than three pixels are a sum of travelling waves, with normally distributed slopes as well: so the mean over many
// places is the distribution of Cox & Munk at any GSD.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace skysweep::scene {

// Of Cox & Munk's: mean of the squared slope, dz over way, of a clean sea surface.
double mean_square_slope(double wind_mps);

// Immutable: safe to share between threads.
class WaterWaves {
 public:
  WaterWaves(double wind_mps, double wind_from_deg, double gsd_m, std::uint64_t seed);

  // Slope (dz/dx, dz/dy) of the waves that are seen one by one.
  Vec2d slope(Vec2d place, double time_s) const;

  // Mean square slope of those waves, and of the finer ones that roughen them: together that of Cox & Munk.
  double seen_variance() const { return seen_variance_; }
  double fine_variance() const { return fine_variance_; }

 private:
  struct Wave {
    Vec2d per_m;          // wave vector, radians a metre
    double per_s, phase;  // radians
    Vec2d slope;          // at its steepest place
  };
  std::vector<Wave> waves_;  // none where even the longest are finer than three pixels
  double seen_variance_ = 0, fine_variance_ = 0;
};

}  // namespace skysweep::scene
