// SPDX-License-Identifier: Apache-2.0
// Lanes of a packet of rays that nobody asked for.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

namespace skysweep::scene {

// Makes all lanes rays that Embree passes over; to be called before the wanted ones are filled in. The mask alone does
// not do: where the processor has no packets of sixteen (without AVX-512), Embree 3 takes the packet for a stream of
// rays and looks at tnear <= tfar only. Lanes left as the stack had them end the program there at an assertion.
inline void make_idle(RTCRay16& rays) {
  constexpr int kLanes = 16;
  for (float* values : {rays.org_x, rays.org_y, rays.org_z, rays.dir_x, rays.dir_y, rays.tfar, rays.time})
    std::fill_n(values, kLanes, 0.f);
  std::fill_n(rays.dir_z, kLanes, 1.f);
  std::fill_n(rays.tnear, kLanes, 1.f);  // behind its end
  std::fill_n(rays.mask, kLanes, ~0u);
  std::fill_n(rays.flags, kLanes, 0u);
}

}  // namespace skysweep::scene
