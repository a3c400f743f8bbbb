// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target; dispatched once per row of a block.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/cpu/match_cpu.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "sweep/cpu/match_cpu.h"
#include "sweep/cpu/view_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kSegmentCells>;
using I = hn::RebindToSigned<F>;
using D = hn::ScalableTag<double>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Exact pixel positions of the knots of one row, plane and view; NaN where the camera cannot show the point.
struct Knots {
  // Room for a whole vector of the widest instruction set behind the last knot.
  alignas(64) std::array<double, kKnots + 8> u, v;
};

HWY_INLINE void project_knots(const ViewKernel& view, Vec2d first_cell, double cell_m, double z, Knots& knots) {
  const D d;
  const Mat3d& r = view.cam_from_world;
  const double dy = first_cell.y - view.center.y, dz = z - view.center.z;
  const double dx0 = first_cell.x - kKnotsBefore * kSegmentCells * cell_m - view.center.x;
  const auto coefficient = [&](double value) { return hn::Set(d, value); };
  const auto one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const auto nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const camera::Distortion& lens = view.distortion;
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
  }
}

// One pixel coordinate along a segment: base + c[0] + t (c[1] + t (... c[5])), t = 0..1 over kSegmentCells cells, the
// polynomial through six knots, two before the segment's own two and two after. Subtracting the whole pixel `base`
// before going to single precision keeps positions good to a few millionths of a pixel.
struct Segment {
  int base = 0;
  std::array<float, 6> c;
};

// Rows: coefficients of t^j over 120; columns: knots at t = -2..3 (inverse of the Vandermonde matrix).
constexpr double kQuintic[6][6] = {{0, 0, 120, 0, 0, 0},      {6, -60, -40, 120, -30, 4}, {-5, 80, -150, 80, -5, 0},
                                   {-5, -5, 50, -70, 35, -5}, {5, -20, 30, -20, 5, 0},    {-1, 5, -10, 10, -5, 1}};

HWY_INLINE Segment polynomial_through(const double* knot) {
  const double base = std::floor(knot[2]);
  Segment out{static_cast<int>(base), {static_cast<float>(knot[2] - base)}};
  for (int j = 1; j < 6; ++j) {
    double sum = 0;
    for (int k = 0; k < 6; ++k) sum += kQuintic[j][k] * knot[k];
    out.c[j] = static_cast<float>(sum / 120);
  }
  return out;
}

// Where one view shows the cells of a segment, relative to whole pixels; and which cells it shows at all.
struct Positions {
  alignas(64) std::array<float, kSegmentCells> u, v;
  alignas(64) std::array<float, kSegmentCells> shown;  // 1 or 0
  int base_u = 0, base_v = 0;
};

// The cells of a segment one by one, exactly: for segments that touch a place the camera cannot show.
HWY_NOINLINE bool positions_one_by_one(const ViewKernel& view, Vec2d first_cell, double cell_m, double z,
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
HWY_INLINE bool positions_of(const ViewKernel& view, const Knots& knots, int segment, Positions& out, bool& all) {
  const F f;
  const Segment u = polynomial_through(knots.u.data() + segment), v = polynomial_through(knots.v.data() + segment);
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
      VF sum = hn::Set(f, s.c[5]);
      for (int j = 4; j >= 0; --j) sum = hn::MulAdd(t, sum, hn::Set(f, s.c[j]));
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

// Two neighbouring 16-bit pixels per lane, from 16-bit element offsets: the left one in the low half.
HWY_INLINE VI gather_pixel_pairs(const std::uint16_t* pixels, VI offsets) {
  const I i32;
#if HWY_TARGET <= HWY_AVX2
  return hn::GatherOffset(i32, reinterpret_cast<const std::int32_t*>(pixels), hn::ShiftLeft<1>(offsets));
#else
  alignas(64) std::array<std::int32_t, kSegmentCells> lanes;
  hn::Store(offsets, i32, lanes.data());
  for (std::size_t lane = 0; lane < hn::Lanes(i32); ++lane) std::memcpy(&lanes[lane], pixels + lanes[lane], 4);
  return hn::Load(i32, lanes.data());
#endif
}

HWY_INLINE VF left_pixel(VI pair) { return hn::ConvertTo(F(), hn::And(pair, hn::Set(I(), 0xFFFF))); }
HWY_INLINE VF right_pixel(VI pair) {
  return hn::ConvertTo(F(), hn::BitCast(I(), hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<F>(), pair))));
}

// A position along one axis at a mipmap level: whole part base + index, and the weight of the next pixel.
struct AxisLevel {
  int base;
  float remainder;
};
HWY_INLINE AxisLevel axis_at_level(int base, float scale) {
  const double at_level = base * static_cast<double>(scale) - 0.5;
  const double whole = std::floor(at_level);
  return {static_cast<int>(whole), static_cast<float>(at_level - whole)};
}

// Luminance of one view at one level for a whole segment, in stored units. Cells that are not shown read some pixel
// inside the array.
HWY_INLINE void sample_segment(const LevelKernel& level, const Positions& positions, float* HWY_RESTRICT out) {
  const F f;
  const I i32;
  const AxisLevel ax = axis_at_level(positions.base_u, level.scale), ay = axis_at_level(positions.base_v, level.scale);
  const VF scale = hn::Set(f, level.scale), remainder_x = hn::Set(f, ax.remainder),
           remainder_y = hn::Set(f, ay.remainder);
  const VI base_x = hn::Set(i32, ax.base), base_y = hn::Set(i32, ay.base), stride = hn::Set(i32, level.stride);
  const VI border = hn::Set(i32, -1), last_x = hn::Set(i32, level.width - 1), last_y = hn::Set(i32, level.height - 1);
  const VI origin = hn::Set(i32, level.stride + 1);  // element of pixel (0, 0), inside the border
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const VF x = hn::MulAdd(hn::Load(f, positions.u.data() + i), scale, remainder_x);
    const VF y = hn::MulAdd(hn::Load(f, positions.v.data() + i), scale, remainder_y);
    const VF whole_x = hn::Floor(x), whole_y = hn::Floor(y);
    const VF weight_x = hn::Sub(x, whole_x), weight_y = hn::Sub(y, whole_y);
    const VI column = hn::Min(hn::Max(hn::Add(hn::ConvertTo(i32, whole_x), base_x), border), last_x);
    const VI row = hn::Min(hn::Max(hn::Add(hn::ConvertTo(i32, whole_y), base_y), border), last_y);
    const VI offset = hn::Add(hn::Add(hn::Mul(row, stride), column), origin);
    const VI upper = gather_pixel_pairs(level.pixels, offset);
    const VI lower = gather_pixel_pairs(level.pixels + level.stride, offset);
    const VF upper_left = left_pixel(upper), lower_left = left_pixel(lower);
    const VF a = hn::MulAdd(weight_x, hn::Sub(right_pixel(upper), upper_left), upper_left);
    const VF b = hn::MulAdd(weight_x, hn::Sub(right_pixel(lower), lower_left), lower_left);
    hn::Store(hn::MulAdd(weight_y, hn::Sub(b, a), a), f, out + i);
  }
}

// Sums of absolute differences C_k of `count` views over one level, added to `costs`; rows of kSegmentCells values.
HWY_INLINE void add_differences(const float* HWY_RESTRICT luminance, const float* HWY_RESTRICT shown, int count,
                                bool all, float* HWY_RESTRICT costs) {
  const F f;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    for (int k = 0; k + 1 < count; ++k) {
      const VF yk = hn::Load(f, luminance + k * kSegmentCells + i);
      const VF shown_k = hn::Load(f, shown + k * kSegmentCells + i);
      VF sum = hn::Load(f, costs + k * kSegmentCells + i);
      for (int j = k + 1; j < count; ++j) {
        VF difference = hn::AbsDiff(hn::Load(f, luminance + j * kSegmentCells + i), yk);
        if (!all) difference = hn::Mul(difference, hn::Mul(shown_k, hn::Load(f, shown + j * kSegmentCells + i)));
        sum = hn::Add(sum, difference);
        float* other = costs + j * kSegmentCells + i;
        hn::Store(hn::Add(hn::Load(f, other), difference), f, other);
      }
      hn::Store(sum, f, costs + k * kSegmentCells + i);
    }
  }
}

// Moves the `wanted` smallest of `count` values of every lane to the front, in ascending order.
HWY_INLINE void smallest_first(float* HWY_RESTRICT values, int count, int wanted) {
  const F f;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    for (int k = 0; k < wanted; ++k) {
      VF least = hn::Load(f, values + k * kSegmentCells + i);
      for (int j = k + 1; j < count; ++j) {
        float* other = values + j * kSegmentCells + i;
        const VF value = hn::Load(f, other);
        hn::Store(hn::Max(least, value), f, other);
        least = hn::Min(least, value);
      }
      hn::Store(least, f, values + k * kSegmentCells + i);
    }
  }
}

// AC of a segment from the C_k: see view_costs.h for the formula. `costs` is destroyed.
HWY_INLINE void aggregate_segment(float* HWY_RESTRICT costs, const float* HWY_RESTRICT shown, int count,
                                  const SweepOptions& options, float* HWY_RESTRICT out, float* HWY_RESTRICT views) {
  const F f;
  const bool better_half = options.aggregation == Aggregation::better_half;
  const VF zero = hn::Zero(f), one = hn::Set(f, 1.0f), infinity = hn::Set(f, kInfinity);
  const float levels = static_cast<float>(options.window_level_max - options.window_level_min + 1);
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    VF n = zero;
    for (int k = 0; k < count; ++k) {
      const VF shown_k = hn::Load(f, shown + k * kSegmentCells + i);
      n = hn::Add(n, shown_k);
      float* cost = costs + k * kSegmentCells + i;
      if (better_half) hn::Store(hn::IfThenElse(hn::Eq(shown_k, zero), infinity, hn::Load(f, cost)), f, cost);
    }
    hn::Store(n, f, views + i);
  }
  if (better_half) smallest_first(costs, count, std::max(1, count / 2));
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const VF n = hn::Load(f, views + i);
    const VF used = better_half ? hn::Max(one, hn::Floor(hn::Mul(n, hn::Set(f, 0.5f)))) : n;
    VF sum = zero;
    for (int k = 0; k < count; ++k) {
      const VF cost = hn::Load(f, costs + k * kSegmentCells + i);
      sum =
          hn::Add(sum, better_half ? hn::IfThenElseZero(hn::Lt(hn::Set(f, static_cast<float>(k)), used), cost) : cost);
    }
    const VF terms = hn::Mul(hn::Mul(used, hn::Sub(n, one)), hn::Set(f, levels * static_cast<float>(kLuminanceScale)));
    const auto enough = hn::Ge(n, hn::Set(f, static_cast<float>(options.min_views)));
    hn::Store(hn::IfThenElse(enough, hn::Div(sum, terms), infinity), f, out + i);
  }
}

// Takes the costs of plane k into the running winner; planes come in ascending order.
HWY_INLINE void keep_winner(const float* HWY_RESTRICT costs, const float* HWY_RESTRICT views, int k, int first,
                            RowState& state) {
  const F f;
  const I i32;
  const VF infinity = hn::Set(f, kInfinity);
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const int at = first + i;
    const VF cost = hn::Load(f, costs + i);
    const VF best = hn::Load(f, state.best.data() + at);
    const VI plane = hn::Load(i32, state.plane.data() + at);
    const auto follows_best = hn::RebindMask(f, hn::Eq(plane, hn::Set(i32, k - 1)));
    const auto better = hn::Lt(cost, best);
    VF above = hn::Load(f, state.above.data() + at);
    above = hn::IfThenElse(follows_best, cost, above);
    above = hn::IfThenElse(better, infinity, above);
    const VF previous = hn::Load(f, state.previous.data() + at);
    const VF below = hn::IfThenElse(better, previous, hn::Load(f, state.below.data() + at));
    const auto known = hn::Lt(cost, infinity);
    hn::Store(above, f, state.above.data() + at);
    hn::Store(below, f, state.below.data() + at);
    hn::Store(hn::IfThenElse(better, cost, best), f, state.best.data() + at);
    hn::Store(hn::IfThenElse(hn::RebindMask(i32, better), hn::Set(i32, k), plane), i32, state.plane.data() + at);
    hn::Store(hn::IfThenElse(better, hn::Load(f, views + i), hn::Load(f, state.views.data() + at)), f,
              state.views.data() + at);
    hn::Store(hn::Add(hn::Load(f, state.sum.data() + at), hn::IfThenElseZero(known, cost)), f, state.sum.data() + at);
    hn::Store(hn::Add(hn::Load(f, state.seen.data() + at), hn::IfThenElseZero(known, hn::Set(f, 1.0f))), f,
              state.seen.data() + at);
    hn::Store(cost, f, state.previous.data() + at);
  }
}

// Costs of one segment at one plane; false if fewer than min_views views show any of it.
HWY_INLINE bool segment_costs(const RowJob& job, const Knots* knots, int segment, double z, float* HWY_RESTRICT out,
                              float* HWY_RESTRICT view_count) {
  const std::vector<ViewKernel>& views = *job.views;
  std::array<Positions, kMaxViews> positions;
  alignas(64) std::array<float, kMaxViews * kSegmentCells> shown;
  alignas(64) std::array<float, kMaxViews * kSegmentCells> luminance;
  alignas(64) std::array<float, kMaxViews * kSegmentCells> costs;
  std::array<const ViewKernel*, kMaxViews> active;
  int count = 0;
  bool all = true;
  for (std::size_t v = 0; v < views.size(); ++v) {
    Positions& p = positions[count];
    bool all_of_view = true;
    const double* u = knots[v].u.data() + segment;
    const double sum = u[0] + u[1] + u[2] + u[3] + u[4] + u[5];  // NaN if any knot is
    const Vec2d first{job.first_cell.x + segment * kSegmentCells * job.cell_m, job.first_cell.y};
    bool any;
    if (std::isnan(sum)) {
      any = positions_one_by_one(views[v], first, job.cell_m, z, p);
      all_of_view = false;
    } else {
      any = positions_of(views[v], knots[v], segment, p, all_of_view);
    }
    if (!any) continue;
    all = all && all_of_view;
    std::memcpy(shown.data() + count * kSegmentCells, p.shown.data(), sizeof(p.shown));
    active[count++] = &views[v];
  }
  if (count < job.options->min_views) return false;

  std::memset(costs.data(), 0, sizeof(float) * count * kSegmentCells);
  const int levels = job.options->window_level_max - job.options->window_level_min + 1;
  for (int level = 0; level < levels; ++level) {
    for (int k = 0; k < count; ++k)
      sample_segment(active[k]->levels[level], positions[k], luminance.data() + k * kSegmentCells);
    add_differences(luminance.data(), shown.data(), count, all, costs.data());
  }
  aggregate_segment(costs.data(), shown.data(), count, *job.options, out, view_count);
  return true;
}

void match_row(const RowJob& job, RowState& state) {
  const int segments = (job.cells + kSegmentCells - 1) / kSegmentCells;
  std::array<Knots, kMaxViews> knots;
  alignas(64) std::array<float, kSegmentCells> costs, views;
  for (int k = job.planes.first; k <= job.planes.last; ++k) {
    const double z = k * job.dz_m;
    for (std::size_t v = 0; v < job.views->size(); ++v)
      project_knots((*job.views)[v], job.first_cell, job.cell_m, z, knots[v]);
    for (int segment = 0; segment < segments; ++segment) {
      if (!segment_costs(job, knots.data(), segment, z, costs.data(), views.data())) {
        costs.fill(kInfinity);
        views.fill(0);
      }
      keep_winner(costs.data(), views.data(), k, segment * kSegmentCells, state);
    }
  }
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/error.h"
#include "sweep/backend.h"
#include "sweep/sampling_level.h"

namespace skysweep::sweep::cpu {

HWY_EXPORT(match_row);

ViewKernel make_view_kernel(const View& view, const SweepOptions& options) {
  const camera::CameraModel& model = view.camera.model();
  ViewKernel kernel;
  kernel.cam_from_world = view.camera.pose().cam_from_world;
  kernel.center = view.camera.pose().center;
  kernel.fx = model.fx_px, kernel.fy = model.fy_px;
  kernel.cx = model.cx_px, kernel.cy = model.cy_px;
  kernel.distortion = model.distortion;
  kernel.fold_radius_squared = camera::fold_radius_squared(model.distortion);
  kernel.width = static_cast<float>(model.width_px);
  kernel.height = static_cast<float>(model.height_px);
  kernel.camera = &view.camera;
  for (int window = options.window_level_min; window <= options.window_level_max; ++window) {
    const int level = sampling_level(view, window);
    const LuminanceLevel& image = view.image->luminance(level);
    kernel.levels[window - options.window_level_min] = {image.values.data(), image.stride, image.width, image.height,
                                                        std::ldexp(1.0f, -level)};
  }
  return kernel;
}

namespace {

RowState empty_state() {
  RowState state;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (auto* costs : {&state.best, &state.below, &state.above, &state.previous}) costs->fill(infinity);
  for (auto* counts : {&state.sum, &state.seen, &state.views}) counts->fill(0);
  state.plane.fill(std::numeric_limits<std::int32_t>::min());
  return state;
}

void store(const RowState& state, int first_column, int row, int cells, MatchResult& result) {
  for (int i = 0; i < cells; ++i) {
    if (state.seen[i] == 0) continue;
    const int column = first_column + i;
    result.plane(column, row) = state.plane[i];
    result.cost(column, row) = state.best[i];
    result.cost_below(column, row) = state.below[i];
    result.cost_above(column, row) = state.above[i];
    result.mean_cost(column, row) = state.sum[i] / state.seen[i];
    result.view_count(column, row) = static_cast<std::uint8_t>(state.views[i]);
  }
}

}  // namespace

MatchResult match_planes(const SweepProblem& problem, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  std::vector<ViewKernel> views;
  for (const View& view : problem.views) views.push_back(make_view_kernel(view, problem.options));
  executor.parallel_for(problem.grid.height, [&](int row) {
    for (int block = 0; block < problem.block_planes.width(); ++block) {
      const int first_column = block * kBlockCells;
      RowJob job{&views,
                 &problem.options,
                 problem.grid.cell_center(first_column, row),
                 problem.grid.cell_m,
                 problem.dz_m,
                 std::min(kBlockCells, problem.grid.width - first_column),
                 problem.planes_at(first_column, row)};
      if (job.planes.empty()) continue;
      RowState state = empty_state();
      HWY_DYNAMIC_DISPATCH(match_row)(job, state);
      store(state, first_column, row, job.cells, result);
    }
  });
  return result;
}

}  // namespace skysweep::sweep::cpu

namespace skysweep::sweep {

std::vector<std::string> cpu_instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

std::string cpu_instruction_set_in_use() { return cpu_instruction_sets().front(); }

void use_cpu_instruction_set(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);  // everything the machine has is allowed again
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (hwy::TargetName(target) != name) continue;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return;
  }
  throw usage_error("This machine does not have the instruction set '" + name + "'.");
}

}  // namespace skysweep::sweep
#endif  // HWY_ONCE
