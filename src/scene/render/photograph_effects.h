// SPDX-License-Identifier: Apache-2.0
// Where something may act on the way from the world to the grey levels of one photograph. src/scene/effects/ implements
// it for scenes that name effects; for all others there is no such object and nothing is called.
#pragma once

#include <array>
#include <memory>

#include "core/vec.h"
#include "scene/world/moment.h"

namespace skysweep::scene {

// Rays of a few pixels of a row, before they leave the camera.
struct SampleBatch {
  int row = 0;
  int channel = -1;           // 0 red, 1 green, 2 blue, or -1: all in one
  int round = 0, rounds = 1;  // which group of four samples of each pixel
  int samples_of_round = 4;   // sample i is number i % 4 of its pixel's group
  int count = 0;
  std::array<Vec3d, Tracer::kBatch> direction;  // camera frame, z = 1
  std::array<Vec3d, Tracer::kBatch> offset;     // start, from the centre of projection, camera frame, metres
  std::array<double, Tracer::kBatch> time_s;    // from the moment for which the pose stands

  // Which of its pixel's `samples` the i-th is: 0, 1, ...
  int sample(int i) const { return round * samples_of_round + i % samples_of_round; }
  int samples() const { return rounds * samples_of_round; }
};

// Used by one thread.
class RowEffects {
 public:
  virtual ~RowEffects() = default;
  virtual void bend(SampleBatch& batch) = 0;
  // From the surface to the camera: what it throws back by the direction of view, and what the air does.
  virtual void through_air(const Ray* rays, const SurfacePoint* hits, int count, LinearRgb* light) = 0;
  // Lens, exposure and sensor on a finished row of linear light; `gain` is the photograph's own exposure.
  virtual void develop(LinearRgb* row, int width, float gain) = 0;
};

// Safe to call from several threads.
class PhotographEffects {
 public:
  virtual ~PhotographEffects() = default;
  virtual int rounds() const = 0;           // groups of four samples that each pixel needs
  virtual bool channels_apart() const = 0;  // whether red, green and blue need rays of their own
  virtual Vec3d velocity_mps() const = 0;   // of the camera
  virtual const Moment& moment() const = 0;
  virtual std::unique_ptr<RowEffects> begin_row(int row) const = 0;
};

}  // namespace skysweep::scene
