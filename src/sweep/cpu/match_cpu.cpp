// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set by Highway's foreach_target; dispatched once per run of cells.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep/cpu/match_cpu.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "sweep/cpu/aggregation-inl.h"
#include "sweep/cpu/match_cpu.h"
#include "sweep/cpu/positions-inl.h"
#include "sweep/cpu/sampling-inl.h"
#include "sweep/cpu/view_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skysweep::sweep::cpu::HWY_NAMESPACE {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Scratch of one run: large, so made once for it.
struct Workspace {
  std::array<Knots, kMaxViews> knots;
  std::array<int, kMaxViews> near;  // views that may show a cell of the run at the plane in work, ascending
  int near_count = 0;
  std::array<Positions, kMaxViews> positions;
  std::array<const ViewKernel*, kMaxViews> active;  // views that show any cell of the segment
  SegmentSamples samples;
  SegmentDifferences differences;
  alignas(64) std::array<float, kSegmentCells> shown_by;  // views that show the cell, whether hidden or not
  alignas(64) std::array<float, kSegmentCells> costs;
};

HWY_INLINE void add_shown(const Positions& positions, Workspace& work) {
  const F f;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f)))
    hn::Store(hn::Add(hn::Load(f, work.shown_by.data() + i), hn::Load(f, positions.shown.data() + i)), f,
              work.shown_by.data() + i);
}

// The view no longer shows cells from which height z is hidden; returns whether it shows any.
HWY_INLINE bool keep_visible(const float* HWY_RESTRICT lowest_visible, float z, Positions& positions, bool& all) {
  const F f;
  bool any = false;
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const auto sees = hn::Ge(hn::Set(f, z), hn::LoadU(f, lowest_visible + i));
    const VF shown = hn::IfThenElseZero(sees, hn::Load(f, positions.shown.data() + i));
    hn::Store(shown, f, positions.shown.data() + i);
    all = all && hn::AllTrue(f, sees);
    any = any || !hn::AllTrue(f, hn::Eq(shown, hn::Zero(f)));
  }
  return any;
}

// Heights that enough views would show, were they not hidden, get the cost of hidden ones instead of none.
HWY_INLINE void price_hidden(const SweepOptions& options, Workspace& work) {
  const F f;
  const VF infinity = hn::Set(f, kInfinity);
  for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
    const VF cost = hn::Load(f, work.costs.data() + i);
    const auto hidden = hn::And(hn::Eq(cost, infinity), hn::Ge(hn::Load(f, work.shown_by.data() + i),
                                                               hn::Set(f, static_cast<float>(options.min_views))));
    hn::Store(hn::IfThenElse(hidden, hn::Set(f, static_cast<float>(options.hidden_cost)), cost), f,
              work.costs.data() + i);
  }
}

// Projects the knots of the run at one plane, and leaves out the views that show nothing of it.
HWY_INLINE void find_near_views(const RunJob& job, double z, Workspace& work) {
  work.near_count = 0;
  for (std::size_t v = 0; v < job.views->size(); ++v) {
    const ViewKernel& view = (*job.views)[v];
    Knots& knots = work.knots[v];
    const bool all = project_knots(view, job.first_cell, job.cell_m, z, knots);
    if (!all || (may_reach(knots.u, view.width) && may_reach(knots.v, view.height)))
      work.near[work.near_count++] = static_cast<int>(v);
  }
}

// Finds the views that show a segment at one plane, and where.
HWY_INLINE void find_positions(const RunJob& job, int segment, double z, Workspace& work) {
  SegmentSamples& samples = work.samples;
  samples.count = 0;
  samples.all = true;
  work.shown_by.fill(0);
  for (int i = 0; i < work.near_count; ++i) {
    const int index = work.near[i];
    const ViewKernel& view = (*job.views)[index];
    Positions& positions = work.positions[samples.count];
    bool any = false, all = true;
    Segment u, v;
    if (polynomial_through(work.knots[index].u.data() + segment, u) &&
        polynomial_through(work.knots[index].v.data() + segment, v)) {
      any = positions_of(view, u, v, positions, all);
    } else {
      const Vec2d first{job.first_cell.x + segment * kSegmentCells * job.cell_m, job.first_cell.y};
      any = positions_one_by_one(view, first, job.cell_m, z, positions);
      all = false;
    }
    if (!any) continue;
    if (job.lowest_visible) {
      add_shown(positions, work);
      if (!keep_visible(job.lowest_visible + index * kRunCells + segment * kSegmentCells, static_cast<float>(z),
                        positions, all))
        continue;
    }
    samples.all = samples.all && all;
    std::memcpy(samples.shown.data() + samples.count * kSegmentCells, positions.shown.data(), sizeof positions.shown);
    work.active[samples.count++] = &view;
  }
}

// Costs of one segment at one plane, into work.costs.
HWY_INLINE void segment_costs(const RunJob& job, int segment, double z, Workspace& work) {
  find_positions(job, segment, z, work);
  if (work.samples.count < job.options->min_views) {
    work.costs.fill(kInfinity);
    if (job.lowest_visible) price_hidden(*job.options, work);
    return;
  }
  work.samples.levels = job.options->window_level_max - job.options->window_level_min + 1;
  for (int level = 0; level < work.samples.levels; ++level)
    for (int k = 0; k < work.samples.count; ++k) {
      sample_segment(work.active[k]->levels[level], work.positions[k], work.samples.luminance_of(level, k));
      apply_gain(*work.active[k], work.samples.luminance_of(level, k));
    }
  take_differences(work.samples, work.differences);
  aggregate_segment(work.samples, work.differences, *job.options, work.costs.data());
  if (job.lowest_visible) price_hidden(*job.options, work);
}

// Where a segment stands among the ranges of its planes while k ascends.
struct Cursor {
  const PlaneSet* planes = nullptr;
  std::size_t range = 0;
  int slot = 0;  // of the range (cost_volume.h)

  // Whether plane k is searched; k must not be less than before.
  HWY_INLINE bool reaches(int k) {
    if (!planes) return false;
    const std::vector<PlaneRange>& ranges = planes->ranges();
    while (range < ranges.size() && ranges[range].last < k) slot += padded_planes(ranges[range++]);
    return range < ranges.size() && ranges[range].first <= k;
  }
  PlaneRange current() const { return planes->ranges()[range]; }
};

// Calls take(segment, cursor, k, costs) with the costs of one segment at a time, planes in ascending order.
template <typename Take>
HWY_INLINE void for_each_segment(const RunJob& job, Take take) {
  std::array<Cursor, kSegmentsPerRun> cursors;
  PlaneRange hull;
  for (int segment = 0; segment < kSegmentsPerRun; ++segment) {
    cursors[segment].planes = job.planes[segment];
    if (job.planes[segment]) hull.include(job.planes[segment]->hull());
  }
  Workspace work;
  for (int k = hull.first; k <= hull.last; ++k) {
    std::array<bool, kSegmentsPerRun> wanted;
    for (int segment = 0; segment < kSegmentsPerRun; ++segment) wanted[segment] = cursors[segment].reaches(k);
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) continue;
    const double z = k * job.dz_m;
    find_near_views(job, z, work);
    for (int segment = 0; segment < kSegmentsPerRun; ++segment) {
      if (!wanted[segment]) continue;
      segment_costs(job, segment, z, work);
      take(segment, cursors[segment], k, work.costs.data());
    }
  }
}

// Takes the costs of plane k into the running winner; planes come in ascending order.
// `range_begins`: plane k - 1 was not searched.
HWY_INLINE void keep_winner(const float* HWY_RESTRICT costs, int k, bool range_begins, int first, RunState& state) {
  const F f;
  const I i32;
  const VF infinity = hn::Set(f, kInfinity);
  if (range_begins) std::fill_n(state.previous.begin() + first, kSegmentCells, kInfinity);
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
    hn::Store(hn::Add(hn::Load(f, state.sum.data() + at), hn::IfThenElseZero(known, cost)), f, state.sum.data() + at);
    hn::Store(hn::Add(hn::Load(f, state.seen.data() + at), hn::IfThenElseZero(known, hn::Set(f, 1.0f))), f,
              state.seen.data() + at);
    hn::Store(cost, f, state.previous.data() + at);
  }
}

void match_run(const RunJob& job, RunState& state) {
  for_each_segment(job, [&](int segment, const Cursor& cursor, int k, const float* costs) {
    keep_winner(costs, k, k == cursor.current().first, segment * kSegmentCells, state);
  });
}

// Costs of a run into the volume: `cells` are the first cells of the segments, `strides` the elements from one cell to
// the next.
void fill_run(const RunJob& job, const std::array<Cost*, kSegmentsPerRun>& cells,
              const std::array<int, kSegmentsPerRun>& strides) {
  const F f;
  const I i32;
  for_each_segment(job, [&](int segment, const Cursor& cursor, int k, const float* costs) {
    alignas(64) std::array<Cost, kSegmentCells> quantized;
    for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f))) {
      const VF units = hn::Mul(hn::Load(f, costs + i), hn::Set(f, static_cast<float>(kCostScale)));
      hn::Store(hn::NearestInt(hn::Min(units, hn::Set(f, static_cast<float>(kWorstCost)))), i32, quantized.data() + i);
    }
    const int count = std::min(kSegmentCells, job.cells - segment * kSegmentCells);
    const std::ptrdiff_t stride = strides[segment];
    Cost* to = cells[segment] + cursor.slot + (k - cursor.current().first);
    for (int i = 0; i < count; ++i) to[i * stride] = quantized[i];
  });
}

// Segment after segment along the rows of one level, a fraction of a pixel apart from the grid.
double sample_everywhere(const ImagePyramid& image, long long samples) {
  const F f;
  const LuminanceLevel& luminance = image.luminance(0);
  const LevelKernel level{luminance.pairs.data(), luminance.stride, luminance.width, luminance.height, 1};
  Positions positions;
  for (int i = 0; i < kSegmentCells; ++i) {
    positions.u[i] = 0.9f * static_cast<float>(i) + 0.7f;
    positions.v[i] = 0.1f * static_cast<float>(i) + 0.6f;
  }
  alignas(64) std::array<float, kSegmentCells> out;
  VF sum = hn::Zero(f);
  for (long long done = 0; done < samples;) {
    for (positions.base_v = 0; positions.base_v + 2 < level.height; ++positions.base_v) {
      for (positions.base_u = 0; positions.base_u + kSegmentCells < level.width; positions.base_u += kSegmentCells) {
        sample_segment(level, positions, out.data());
        for (int i = 0; i < kSegmentCells; i += static_cast<int>(hn::Lanes(f)))
          sum = hn::Add(sum, hn::Load(f, out.data() + i));
        done += kSegmentCells;
      }
    }
  }
  alignas(64) std::array<float, kSegmentCells> lanes;
  hn::Store(sum, f, lanes.data());
  double total = 0;
  for (std::size_t i = 0; i < hn::Lanes(f); ++i) total += lanes[i];
  return total;
}

}  // namespace skysweep::sweep::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "core/error.h"
#include "sweep/backend.h"

namespace skysweep::sweep::cpu {

HWY_EXPORT(match_run);
HWY_EXPORT(fill_run);
HWY_EXPORT(sample_everywhere);

namespace {

RunState empty_state() {
  RunState state;
  for (auto* costs : {&state.best, &state.below, &state.above, &state.previous})
    costs->fill(std::numeric_limits<float>::infinity());
  for (auto* counts : {&state.sum, &state.seen}) counts->fill(0);
  state.plane.fill(std::numeric_limits<std::int32_t>::min());
  return state;
}

void store(const RunState& state, int first_column, int row, int cells, MatchResult& result) {
  for (int i = 0; i < cells; ++i) {
    if (state.seen[i] == 0) continue;
    const int column = first_column + i;
    const Parabola parabola = parabola_through(state.below[i], state.best[i], state.above[i]);
    result.plane(column, row) = state.plane[i];
    result.cost(column, row) = state.best[i];
    result.mean_cost(column, row) = state.sum[i] / state.seen[i];
    result.fraction(column, row) = static_cast<float>(parabola.vertex);
    result.bend(column, row) = static_cast<float>(parabola.bend);
  }
}

// Whether anything is hidden from any view in a run; and from where on the views see its cells.
bool hides_from_run(const SweepProblem& problem, int column, int row, int cells, std::vector<float>& lowest_visible) {
  if (!problem.visibility.any()) return false;
  bool hides = false;
  lowest_visible.assign(problem.views.size() * kRunCells, -std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < problem.views.size(); ++v) {
    for (int i = 0; i < cells; ++i) {
      const float lowest = problem.visibility.lowest_visible(static_cast<int>(v), column + i, row);
      lowest_visible[v * kRunCells + i] = lowest;
      hides = hides || lowest > -std::numeric_limits<float>::infinity();
    }
  }
  return hides;
}

// Calls body(job, first column, row) for every run of cells that has planes.
void for_each_run(const SweepProblem& problem, Executor& executor,
                  const std::function<void(const RunJob&, int, int)>& body) {
  std::vector<ViewKernel> views;
  for (const View& view : problem.views) views.push_back(make_view_kernel(view, problem.options));
  executor.parallel_for(problem.grid.height, [&](int row) {
    std::vector<float> lowest_visible;
    for (int column = 0; column < problem.grid.width; column += kRunCells) {
      RunJob job{&views,
                 &problem.options,
                 problem.grid.cell_center(column, row),
                 problem.grid.cell_m,
                 problem.dz_m,
                 std::min(kRunCells, problem.grid.width - column)};
      bool any = false;
      for (int segment = 0; segment * kSegmentCells < job.cells; ++segment) {
        job.planes[segment] = &problem.planes_at(column + segment * kSegmentCells, row);
        any = any || !job.planes[segment]->empty();
      }
      if (!any) continue;
      if (hides_from_run(problem, column, row, job.cells, lowest_visible)) job.lowest_visible = lowest_visible.data();
      body(job, column, row);
    }
  });
}

}  // namespace

CostVolume match_costs(const SweepProblem& problem, Executor& executor) {
  CostVolume costs(problem, kWorstCost);
  for_each_run(problem, executor, [&](const RunJob& job, int column, int row) {
    std::array<Cost*, kSegmentsPerRun> cells{};
    std::array<int, kSegmentsPerRun> strides{};
    for (int segment = 0; segment * kSegmentCells < job.cells; ++segment) {
      cells[segment] = costs.cell(column + segment * kSegmentCells, row);
      strides[segment] = CostVolume::padded_planes(*job.planes[segment]);
    }
    HWY_DYNAMIC_DISPATCH(fill_run)(job, cells, strides);
  });
  return costs;
}

double sample_everywhere_dispatched(const ImagePyramid& image, long long samples) {
  return HWY_DYNAMIC_DISPATCH(sample_everywhere)(image, samples);
}

MatchResult match_cell_by_cell(const SweepProblem& problem, Executor& executor) {
  MatchResult result(problem.grid.width, problem.grid.height);
  for_each_run(problem, executor, [&](const RunJob& job, int column, int row) {
    RunState state = empty_state();
    HWY_DYNAMIC_DISPATCH(match_run)(job, state);
    store(state, column, row, job.cells, result);
  });
  return result;
}

}  // namespace skysweep::sweep::cpu

namespace skysweep::sweep {

double bilinear_sampling_ceiling(const ImagePyramid& image, long long samples) {
  return cpu::sample_everywhere_dispatched(image, samples);
}

namespace {
std::vector<std::string> allowed_instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}
}  // namespace

std::vector<std::string> cpu_instruction_sets() {
  // Asked before use_cpu_instruction_set restricts them.
  static const std::vector<std::string> all = allowed_instruction_sets();
  return all;
}

std::string cpu_instruction_set_in_use() { return allowed_instruction_sets().front(); }

void use_cpu_instruction_set(const std::string& name) {
  cpu_instruction_sets();
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
