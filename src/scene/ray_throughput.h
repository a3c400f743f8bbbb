// SPDX-License-Identifier: Apache-2.0
// The rays of a scene's first photograph, ready to be traced again and again: what bench/scene_bench.cpp measures.
#pragma once

#include <functional>
#include <memory>

#include "scene/scene.h"

namespace skysweep::scene {

class RayThroughput {
 public:
  // One ray through the centre of each pixel; their number must be a multiple of 16.
  explicit RayThroughput(const Scene& scene);
  ~RayThroughput();

  int rays() const;

  // Each traces all rays on the calling thread.
  std::function<int()> embree_alone() const;  // prepared packets, Embree only; gives back how many rays hit
  int exact_hits() const;                     // where they hit, in double; gives back how many do
  struct Light {
    double mean_green = 0;  // linear
    int shadow_rays = 0;    // traced besides
  };
  Light light() const;  // everything a photograph needs but its encoding

 private:
  struct View;
  std::unique_ptr<const View> view_;
};

}  // namespace skysweep::scene
