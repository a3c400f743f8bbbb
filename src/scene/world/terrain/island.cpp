// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/island.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/world/terrain/fractal.h"
#include "scene/world/terrain/koch.h"

namespace skysweep::scene {
namespace {

constexpr int kPerRadius = 100;                      // lattice points
constexpr double kReach = 1.8;                       // of the lattice, in radii from the centre
constexpr double kShelf = 0.45;                      // radii from the shore where the bed is at its depth
constexpr double kShelfShare = 0.3;                  // of the depth: falls straight from the shore
constexpr double kPlain = 0.22, kPlainWidth = 0.22;  // share of the height, radii

double distance_to_segment(Vec2d p, Vec2d a, Vec2d b) {
  const Vec2d along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0., 1.);
  return norm(p - (a + t * along));
}

double sea_bed(const IslandTerrain& shape, double radii_from_shore) {
  const double x = std::min(1., radii_from_shore / kShelf);
  return -shape.sea_depth_m * (kShelfShare * x + (1 - kShelfShare) * x * x * (3 - 2 * x));
}

// A coastal plain that rises straight from the shore, and a hill on it that begins gently.
double land(const IslandTerrain& shape, double radii_from_shore, double inland) {
  return shape.height_m *
         (kPlain * (1 - std::exp(-radii_from_shore / kPlainWidth)) + (1 - kPlain) * inland * std::sqrt(inland));
}

// How far inland each point of the lattice is, 0 at the shore to 1 at the place furthest from it: the height of a soap
// film over the outline, blown up from below (Poisson's equation, solved by over-relaxation). Unlike the distance from
// the shore it has no ridges. `distances` in radii, negative at sea.
Array2d<double> inland_of(const Array2d<double>& distances) {
  constexpr double kStep = 1. / kPerRadius;
  constexpr double kOverRelaxation = 1.96;
  constexpr int kSweeps = 600;
  Array2d<double> film(distances.width(), distances.height());
  std::vector<std::pair<int, int>> dry;
  for (int j = 1; j + 1 < film.height(); ++j)
    for (int i = 1; i + 1 < film.width(); ++i)
      if (distances(i, j) > 0) dry.emplace_back(i, j);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const auto& [i, j] : dry) {
      const double mean = 0.25 * (film(i - 1, j) + film(i + 1, j) + film(i, j - 1) + film(i, j + 1));
      film(i, j) = std::max(0.0, film(i, j) + kOverRelaxation * (mean + 0.25 * kStep * kStep - film(i, j)));
    }
  const double top = *std::max_element(film.begin(), film.end());
  if (top > 0)
    for (double& value : film) value /= top;
  return film;
}

}  // namespace

Array2d<double> signed_distances(const std::vector<Vec2d>& polygon, Vec2d first, double spacing_m, int width,
                                 int height) {
  constexpr int kBlock = 16;
  const auto corner = [&](std::size_t i) { return polygon[i % polygon.size()]; };
  Array2d<double> out(width, height);
  std::vector<std::size_t> near;
  for (int j0 = 0; j0 < height; j0 += kBlock)
    for (int i0 = 0; i0 < width; i0 += kBlock) {
      // Only sides that may be the nearest of some point of the block.
      const Vec2d middle = first + spacing_m * Vec2d{i0 + 0.5 * (kBlock - 1), j0 + 0.5 * (kBlock - 1)};
      const double reach = 0.5 * (kBlock - 1) * std::sqrt(2.) * spacing_m;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < polygon.size(); ++i)
        nearest = std::min(nearest, distance_to_segment(middle, corner(i), corner(i + 1)));
      near.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i)
        if (distance_to_segment(middle, corner(i), corner(i + 1)) <= nearest + 2 * reach) near.push_back(i);
      for (int j = j0; j < std::min(height, j0 + kBlock); ++j)
        for (int i = i0; i < std::min(width, i0 + kBlock); ++i) {
          const Vec2d p = first + spacing_m * Vec2d{1. * i, 1. * j};
          double distance = std::numeric_limits<double>::infinity();
          for (const std::size_t k : near)
            distance = std::min(distance, distance_to_segment(p, corner(k), corner(k + 1)));
          out(i, j) = distance;
        }
    }
  // Inside where a line from the west has crossed the outline an odd number of times.
  for (int j = 0; j < height; ++j) {
    const double y = first.y + spacing_m * j;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2d a = corner(i), b = corner(i + 1);
      if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::sort(crossings.begin(), crossings.end());
    for (int i = 0; i < width; ++i) {
      const auto passed = std::lower_bound(crossings.begin(), crossings.end(), first.x + spacing_m * i);
      if ((passed - crossings.begin()) % 2 == 0) out(i, j) = -out(i, j);
    }
  }
  return out;
}

HeightGrid build_island(const IslandTerrain& shape, std::uint64_t seed) {
  const double spacing = shape.radius_m / kPerRadius;
  const int side = 1 + static_cast<int>(2 * kReach * kPerRadius);
  const Vec2d first = shape.center - kReach * shape.radius_m * Vec2d{1, 1};
  Array2d<double> z =
      signed_distances(koch_outline(shape.center, shape.radius_m, shape.koch_depth, seed), first, spacing, side, side);
  constexpr double kHillSize = 0.6;  // radii
  constexpr int kHillOctaves = 5;    // the finest has 1/27 of a radius, four points of the lattice
  const Fractal hills({kHillOctaves, 0.5}, shape.hills_m, kHillSize * shape.radius_m, seed);
  for (double& distance : z) distance /= shape.radius_m;
  const Array2d<double> inland = inland_of(z);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      if (z(i, j) <= 0) {
        z(i, j) = sea_bed(shape, -z(i, j));
        continue;
      }
      const double hill = hills.at(first + spacing * Vec2d{1. * i, 1. * j}).z;
      const double share = std::min(1., 2 * inland(i, j));
      z(i, j) = std::max(0.0, land(shape, z(i, j), inland(i, j)) + share * share * hill);
    }
  return {z, first, {spacing, spacing}, HeightGrid::Beyond::border};
}

}  // namespace skysweep::scene
