// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace skysweep::scene {

std::string file_ending(PhotoFormat format) {
  switch (format) {
    case PhotoFormat::png: return "png";
    case PhotoFormat::tiff: return "tif";
    case PhotoFormat::exr: return "exr";
    default: return "jpg";
  }
}

double Scene::finest_detail_m() const { return texture.finest_m > 0 ? texture.finest_m : 0.5 * gsd_m(); }

double Scene::truth_cell_m() const {
  if (truth.cell_m > 0) return truth.cell_m;
  const double wanted = 2 * gsd_m();
  // Division by a power of ten that is exact in double gives the double nearest to the decimal number.
  const double digits = 1 - std::floor(std::log10(wanted));
  return digits >= 0 ? std::round(wanted * std::pow(10, digits)) / std::pow(10, digits)
                     : std::round(wanted / std::pow(10, -digits)) * std::pow(10, -digits);
}

std::vector<const Flight*> Scene::flights() const {
  std::vector<const Flight*> all = {&flight};
  for (const Flight& further : further_flights) all.push_back(&further);
  return all;
}

double Scene::gsd_m() const {
  double finest = flight.resolved_gsd_m(camera.focal_px());
  for (const Flight& further : further_flights) finest = std::min(finest, further.resolved_gsd_m(camera.focal_px()));
  return finest;
}

double Scene::altitude_m() const { return flight.resolved_altitudes_m(camera.focal_px()).front(); }

}  // namespace skysweep::scene
