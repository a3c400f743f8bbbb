// SPDX-License-Identifier: Apache-2.0
// Points of the visible surface with the pixels at which photographs see them, exactly: tie points of a COLMAP model,
// ground control points.
#pragma once

#include <cstdint>
#include <vector>

#include "camera/camera.h"
#include "core/color.h"
#include "scene/world/world.h"

namespace skysweep::scene {

struct SurveyedPoint {
  struct Sighting {
    std::size_t photograph = 0;
    Vec2d pixel;
  };
  Vec3d position;  // scene's frame
  Rgb8 color;
  std::vector<Sighting> sightings;  // in the order of the photographs
};

struct SurveyOptions {
  int count = 400;           // places looked at; those that too few photographs see are left out
  int min_sightings = 3;     // photographs that see a point
  bool on_ground = false;    // bare ground only, no roofs or trees
  std::uint64_t stream = 0;  // random numbers of their own for points of different use
};

// One point, at a seeded place, in each field of a regular division of the mapped area: the highest surface there.
std::vector<SurveyedPoint> survey(const Scene& scene, const World& world, const std::vector<camera::Camera>& cameras,
                                  const SurveyOptions& options);

}  // namespace skysweep::scene
