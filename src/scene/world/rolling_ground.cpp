// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scene/world/rolling_ground.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <numbers>
#include <span>

#include "scene/world/rolling_ground.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::scene::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void meet(std::span<const Waves::Wave> waves, const RayLanes& rays, const float* distance, GroundHits& out) {
  const hn::CappedTag<double, kRayBatch> d;
  const hn::Rebind<float, decltype(d)> narrow;
  using V = hn::Vec<decltype(d)>;
  const V one = hn::Set(d, 1.0), turn = hn::Set(d, 2 * std::numbers::pi), per_turn = hn::Set(d, 0.5 / std::numbers::pi);
  for (std::size_t i = 0; i < kRayBatch; i += hn::Lanes(d)) {
    const V ox = hn::Load(d, &rays.ox[i]), oy = hn::Load(d, &rays.oy[i]), oz = hn::Load(d, &rays.oz[i]);
    const V dx = hn::Load(d, &rays.dx[i]), dy = hn::Load(d, &rays.dy[i]), dz = hn::Load(d, &rays.dz[i]);
    const V t = hn::PromoteTo(d, hn::LoadU(narrow, distance + i));
    const V x = hn::MulAdd(t, dx, ox), y = hn::MulAdd(t, dy, oy);
    V z = hn::Zero(d), slope_x = hn::Zero(d), slope_y = hn::Zero(d);
    for (const Waves::Wave& wave : waves) {
      const V kx = hn::Set(d, wave.wave_number.x), ky = hn::Set(d, wave.wave_number.y);
      const V far = hn::MulAdd(kx, x, hn::MulAdd(ky, y, hn::Set(d, wave.phase)));
      // Within half a turn, where the polynomials of sine and cosine hold.
      const V angle = hn::NegMulAdd(hn::Round(hn::Mul(far, per_turn)), turn, far);
      const V rise = hn::Mul(hn::Set(d, wave.amplitude_m), hn::Cos(d, angle));
      z = hn::MulAdd(hn::Set(d, wave.amplitude_m), hn::Sin(d, angle), z);
      slope_x = hn::MulAdd(rise, kx, slope_x);
      slope_y = hn::MulAdd(rise, ky, slope_y);
    }
    // To the plane that touches the ground at (x, y).
    const V above = hn::Sub(hn::MulAdd(t, dz, oz), z);
    const V closing = hn::Sub(hn::MulAdd(slope_x, dx, hn::Mul(slope_y, dy)), dz);
    const V there = hn::Add(t, hn::Div(above, closing));
    hn::Store(hn::MulAdd(there, dx, ox), d, &out.x[i]);
    hn::Store(hn::MulAdd(there, dy, oy), d, &out.y[i]);
    hn::Store(hn::MulAdd(there, dz, oz), d, &out.z[i]);
    const V per_length = hn::Div(one, hn::Sqrt(hn::MulAdd(slope_x, slope_x, hn::MulAdd(slope_y, slope_y, one))));
    hn::Store(hn::Neg(hn::Mul(slope_x, per_length)), d, &out.nx[i]);
    hn::Store(hn::Neg(hn::Mul(slope_y, per_length)), d, &out.ny[i]);
    hn::Store(per_length, d, &out.nz[i]);
  }
}

}  // namespace skysweep::scene::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skysweep::scene {

HWY_EXPORT(meet);

void meet_rolling_ground(const Waves* waves, const RayLanes& rays, const float* t, GroundHits& out) {
  HWY_DYNAMIC_DISPATCH(meet)
  (waves ? std::span<const Waves::Wave>(waves->waves()) : std::span<const Waves::Wave>(), rays, t, out);
}

}  // namespace skysweep::scene
#endif
