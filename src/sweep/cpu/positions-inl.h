// SPDX-License-Identifier: Apache-2.0
// Where a view shows the cells of a row at one height.
// Included once for every instruction set (Highway's per-target idiom, hence the guard that toggles).
#if defined(SKYSWEEP_SWEEP_CPU_POSITIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKYSWEEP_SWEEP_CPU_POSITIONS_INL_H_
#undef SKYSWEEP_SWEEP_CPU_POSITIONS_INL_H_
#else
#define SKYSWEEP_SWEEP_CPU_POSITIONS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <limits>

#include "sweep/cpu/lanes-inl.h"
#include "sweep/cpu/view_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

using D = hn::ScalableTag<double>;

// Exact pixel positions of the knots of one row, plane and view; NaN where the camera cannot show the point.
struct Knots {
  // Room for a whole vector of the widest instruction set behind the last knot.
  alignas(64) std::array<double, kKnots + 8> u, v;
};

// Returns whether the camera can show the points of all knots.
HWY_INLINE bool project_knots(const ViewKernel& view, Vec2d first_cell, double cell_m, double z, Knots& knots) {
  const D d;
  const Mat3d& r = view.cam_from_world;
  const double dy = first_cell.y - view.center.y, dz = z - view.center.z;
  const double dx0 = first_cell.x - kKnotsBefore * kSegmentCells * cell_m - view.center.x;
  const auto coefficient = [&](double value) { return hn::Set(d, value); };
  const auto one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const auto nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const camera::Distortion& lens = view.distortion;
  bool all = true;
  for (int k = 0; k < kKnots; k += static_cast<int>(hn::Lanes(d))) {
    const auto dx =
        hn::MulAdd(hn::Iota(d, static_cast<double>(k)), coefficient(kSegmentCells * cell_m), coefficient(dx0));
    const auto row = [&](int i) {
      return hn::MulAdd(coefficient(r(i, 0)), dx, coefficient(r(i, 1) * dy + r(i, 2) * dz));
    };
    const auto depth = row(2);
    const auto inverse = hn::Div(one, depth);
    const auto x = hn::Mul(row(0), inverse), y = hn::Mul(row(1), inverse);
    const auto r2 = hn::MulAdd(x, x, hn::Mul(y, y));
    const auto radial = hn::MulAdd(
        r2, hn::MulAdd(r2, hn::MulAdd(r2, coefficient(lens.k3), coefficient(lens.k2)), coefficient(lens.k1)), one);
    const auto xy2 = hn::Mul(two, hn::Mul(x, y));
    const auto tangential_x =
        hn::MulAdd(coefficient(lens.p1), xy2, hn::Mul(coefficient(lens.p2), hn::MulAdd(two, hn::Mul(x, x), r2)));
    const auto tangential_y =
        hn::MulAdd(coefficient(lens.p2), xy2, hn::Mul(coefficient(lens.p1), hn::MulAdd(two, hn::Mul(y, y), r2)));
    const auto distorted_x = hn::MulAdd(x, radial, tangential_x), distorted_y = hn::MulAdd(y, radial, tangential_y);
    const auto usable = hn::And(hn::Gt(depth, hn::Zero(d)), hn::Lt(r2, coefficient(view.fold_radius_squared)));
    const auto u = hn::MulAdd(distorted_x, coefficient(view.fx), coefficient(view.cx));
    const auto v = hn::MulAdd(distorted_y, coefficient(view.fy), coefficient(view.cy));
    hn::Store(hn::IfThenElse(usable, u, nan), d, knots.u.data() + k);
    hn::Store(hn::IfThenElse(usable, v, nan), d, knots.v.data() + k);
    all = all && hn::AllTrue(d, usable);
  }
  return all;
}

// Whether the polynomials through knots may reach pixels 0..size somewhere between those of the run: between the two
// knots in the middle of six, one leaves the middle of their range by less than 1.5 times half of it (the sum of the
// magnitudes of Lagrange's basis polynomials is below 1.4 there). The knots must be numbers.
HWY_INLINE bool may_reach(const std::array<double, kKnots + 8>& knots, double size) {
  const hn::CappedTag<double, kKnots> d;
  static_assert(kKnots % hn::MaxLanes(d) == 0);
  auto low = hn::Load(d, knots.data()), high = low;
  for (int k = static_cast<int>(hn::MaxLanes(d)); k < kKnots; k += static_cast<int>(hn::MaxLanes(d))) {
    low = hn::Min(low, hn::Load(d, knots.data() + k));
    high = hn::Max(high, hn::Load(d, knots.data() + k));
  }
  const double least = hn::GetLane(hn::MinOfLanes(d, low)), most = hn::GetLane(hn::MaxOfLanes(d, high));
  const double reach = 0.25 * (most - least);
  return most + reach >= -1 && least - reach <= size + 1;
}

// One pixel coordinate along a segment: base + c[0] + t (c[1] + t (... c[5])), t = 0..1 over kSegmentCells cells, the
// polynomial through six knots, two before the segment's own two and two after. Subtracting the whole pixel `base`
// before going to single precision keeps positions good to a few millionths of a pixel.
struct Segment {
  int base = 0;
  alignas(32) std::array<float, 8> c;  // the last two are nothing
};

// Columns: what a knot at t = -2..3 adds to the coefficients of t^0..t^5 times 120 (inverse of the Vandermonde matrix).
alignas(64) constexpr double kQuintic[6][8] = {{0, 6, -5, -5, 5, -1},         {0, -60, 80, -5, -20, 5},
                                               {120, -40, -150, 50, 30, -10}, {0, 120, 80, -70, -20, 10},
                                               {0, -30, -5, 35, 5, -5},       {0, 4, 0, -5, 0, 1}};

// Near the plane of the centre of projection 1/depth, and beyond the fold the lens, leave every polynomial behind: a
// segment is trusted to it only while its highest term is so small (the error is below 0.6 of it as long as the sixth
// difference of the knots does not exceed the fifth), and its steepest so moderate that single precision holds it.
constexpr double kLargestFifthTerm = 1.0 / 1024;  // pixels
constexpr double kLargestSlope = 4096;            // pixels per segment
constexpr double kFarthestPixel = 1 << 22;        // whole pixels that single precision and 32 bits hold with ease

// The polynomial through six knots; false, and nothing written, where it is not good to a thousandth of a pixel, and
// for NaN and infinities.
HWY_INLINE bool polynomial_through(const double* HWY_RESTRICT knot, Segment& out) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> f;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(d));
  if (!(std::abs(knot[2]) < kFarthestPixel)) return false;
  const double base = std::floor(knot[2]);
  alignas(64) constexpr double kLargest[8] = {
      kFarthestPixel, kLargestSlope, kFarthestPixel, kFarthestPixel, kFarthestPixel, kLargestFifthTerm, 1, 1};
  bool good = true;
  Segment made;
  for (int j = 0; j < 8; j += kLanes) {
    auto sum = hn::Mul(hn::Load(d, kQuintic[0] + j), hn::Set(d, knot[0]));
    for (int k = 1; k < 6; ++k) sum = hn::MulAdd(hn::Load(d, kQuintic[k] + j), hn::Set(d, knot[k]), sum);
    // The base changes the first coefficient alone.
    const auto first = j == 0 ? hn::IfThenElseZero(hn::FirstN(d, 1), hn::Set(d, base)) : hn::Zero(d);
    sum = hn::MulSub(sum, hn::Set(d, 1.0 / 120), first);
    good = good && hn::AllTrue(d, hn::Lt(hn::Abs(sum), hn::Load(d, kLargest + j)));
    hn::Store(hn::DemoteTo(f, sum), f, made.c.data() + j);
  }
  if (!good) return false;
  made.base = static_cast<int>(base);
  out = made;
  return true;
}

// Where one view shows the cells of a segment, relative to whole pixels; and which cells it shows at all.
struct Positions {
  alignas(64) std::array<float, kSegmentCells> u, v;
  alignas(64) std::array<float, kSegmentCells> shown;  // 1 or 0
  int base_u = 0, base_v = 0;
};

// The cells of a segment one by one, exactly: for segments that touch a place the camera cannot show, or where no
// polynomial follows the projection.
inline HWY_NOINLINE bool positions_one_by_one(const ViewKernel& view, Vec2d first_cell, double cell_m, double z,
                                              Positions& out) {
  bool any = false;
  for (int i = 0; i < kSegmentCells; ++i) {
    const auto pixel = view.camera->project({first_cell.x + i * cell_m, first_cell.y, z});
    const bool shown = pixel && view.camera->shows(*pixel);
    if (shown && !any) {
      out.base_u = static_cast<int>(std::floor(pixel->x));
      out.base_v = static_cast<int>(std::floor(pixel->y));
      any = true;
    }
    out.shown[i] = shown ? 1.0f : 0.0f;
    out.u[i] = shown ? static_cast<float>(pixel->x - out.base_u) : 0.0f;
    out.v[i] = shown ? static_cast<float>(pixel->y - out.base_v) : 0.0f;
  }
  return any;
}

// Returns whether the view shows any of the cells; `all` becomes false if it does not show all of them.
HWY_INLINE bool positions_of(const ViewKernel& view, const Segment& u, const Segment& v, Positions& out, bool& all) {
  const F f;
  out.base_u = u.base;
  out.base_v = v.base;
  // 0 <= base + position <= size, in numbers small enough to be exact.
  const VF u_min = hn::Set(f, static_cast<float>(-u.base)), u_max = hn::Set(f, view.width - static_cast<float>(u.base));
  const VF v_min = hn::Set(f, static_cast<float>(-v.base)),
           v_max = hn::Set(f, view.height - static_cast<float>(v.base));
  bool any = false;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const VF t = hn::Mul(hn::Iota(f, static_cast<float>(i)), hn::Set(f, 1.0f / kSegmentCells));
    const auto evaluate = [&](const Segment& s) {
      const float* c = reloaded(s.c.data());
      VF sum = hn::Set(f, c[5]);
      for (int j = 4; j >= 0; --j) sum = hn::MulAdd(t, sum, hn::Set(f, c[j]));
      return sum;
    };
    const VF pu = evaluate(u), pv = evaluate(v);
    const auto shown =
        hn::And(hn::And(hn::Ge(pu, u_min), hn::Le(pu, u_max)), hn::And(hn::Ge(pv, v_min), hn::Le(pv, v_max)));
    hn::Store(pu, f, out.u.data() + i);
    hn::Store(pv, f, out.v.data() + i);
    hn::Store(hn::IfThenElseZero(shown, hn::Set(f, 1.0f)), f, out.shown.data() + i);
    any = any || !hn::AllFalse(f, shown);
    all = all && hn::AllTrue(f, shown);
  }
  return any;
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SKYSWEEP_SWEEP_CPU_POSITIONS_INL_H_
