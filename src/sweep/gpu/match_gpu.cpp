// SPDX-License-Identifier: Apache-2.0
#include "sweep/gpu/match_gpu.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sweep/bands.h"
#include "sweep/cpu/smoothing_cpu.h"
#include "sweep/gpu/engine.h"
#include "sweep/gpu/volume_layout.h"
#include "sweep/penalties.h"
#include "sweep/sampling_level.h"

namespace skysweep::sweep::on_gpu {
namespace {

using skysweep::gpu::Buffer;
using skysweep::gpu::Current;
using skysweep::gpu::DeviceError;
using skysweep::gpu::Program;
using skysweep::gpu::Trouble;
using Definitions = std::vector<std::pair<std::string, std::string>>;

constexpr int kMatchIntegers = 7, kWinnerNumbers = 6;  // what the programs write for each cell
constexpr float kEverything = -1e30f;                  // below every height: in place of an infinity
constexpr float kNoCost = 1e30f, kNoFraction = 1e30f;  // and how they say that there is nothing

// Runs `work` with the device current. A device that is lost meanwhile is not used again.
template <typename Work>
auto on_device(Work work) {
  const std::shared_ptr<Engine> used = engine();
  try {
    const Current current(used->device());
    return work(*used);
  } catch (const DeviceError& error) {
    if (error.trouble() == Trouble::lost) abandon(used);
    throw;
  }
}

// costs.glsl: Geometry.
std::vector<double> geometry_of(const SweepProblem& problem) {
  const Grid& grid = problem.grid;
  std::vector<double> numbers = {grid.north_west_corner.x, grid.north_west_corner.y, grid.cell_m, problem.dz_m};
  for (const View& view : problem.views) {
    const camera::CameraModel& m = view.camera.model();
    const camera::Pose& pose = view.camera.pose();
    const camera::Distortion& d = m.distortion;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) numbers.push_back(pose.cam_from_world(i, j));
    numbers.insert(numbers.end(), {pose.center.x, pose.center.y, pose.center.z, m.fx_px, m.fy_px, m.cx_px, m.cy_px,
                                   camera::fold_radius_squared(d), d.k1, d.k2, d.p1, d.p2, d.k3});
  }
  return numbers;
}

int window_levels(const SweepOptions& options) { return options.window_level_max - options.window_level_min + 1; }

// costs.glsl: Views, in four numbers a line as std140 has it.
std::vector<float> views_of(const SweepProblem& problem, const std::vector<int>& layers) {
  std::vector<float> numbers;
  const auto add = [&numbers](std::initializer_list<double> four) {
    for (const double value : four) numbers.push_back(static_cast<float>(value));
  };
  for (std::size_t v = 0; v < problem.views.size(); ++v) {
    const View& view = problem.views[v];
    const camera::CameraModel& m = view.camera.model();
    const camera::Distortion& d = m.distortion;
    const Mat3d& r = view.camera.pose().cam_from_world;
    const double cell = problem.grid.cell_m;
    add({m.fx_px, m.fy_px, camera::fold_radius_squared(d), d.none() ? 0. : 1.});
    add({d.k1, d.k2, d.k3, static_cast<double>(layers[v])});
    add({d.p1, d.p2, static_cast<double>(m.width_px), static_cast<double>(m.height_px)});
    add({cell * r(0, 0), cell * r(1, 0), cell * r(2, 0), 0});
    add({-cell * r(0, 1), -cell * r(1, 1), -cell * r(2, 1), 0});
    const LayerLayout layout = layer_layout(*view.image);
    for (int window = problem.options.window_level_min; window <= problem.options.window_level_max; ++window) {
      const int level = sampling_level(view, window);
      const LuminanceLevel& image = view.image->luminance(level);
      const PlacedLevel& placed = layout.levels[level];
      add({double(placed.x), double(placed.y), double(image.width - 1), double(image.height - 1)});
      add({std::ldexp(1.0, -level), view.gain, view.offset * kLuminanceScale / 65535, 0});  // texels are 0 to 1
    }
  }
  return numbers;
}

// The macros by which costs.glsl goes through views, pairs and levels. Beyond so many views, unrolled code grows faster
// than it runs.
constexpr int kUnrolledViews = 12;

Definitions loops(int views, int levels) {
  std::string all_views, all_pairs, all_levels;
  for (int i = 0; i < views; ++i) {
    all_views += "f(" + std::to_string(i) + "); ";
    for (int k = i + 1; k < views; ++k) all_pairs += "f(" + std::to_string(i) + ", " + std::to_string(k) + "); ";
  }
  if (views > kUnrolledViews) {
    all_views = "for (int each = 0; each < VIEWS; ++each) f(each);";
    all_pairs =
        "for (int one = 0; one + 1 < VIEWS; ++one) for (int other = one + 1; other < VIEWS; ++other) f(one, other);";
  }
  for (int l = 0; l < levels; ++l) all_levels += "f(v, " + std::to_string(l) + ") ";
  return {{"ALL_VIEWS(f)", all_views}, {"ALL_PAIRS(f)", all_pairs}, {"ALL_LEVELS(f, v)", all_levels}};
}

// The horizons' cells that the problem's grid reaches into, from the first row of it on.
int first_horizon_row(const VisibilityLimit& limit) { return limit.first_row / limit.times; }
int horizon_width(const SweepProblem& problem) { return (problem.grid.width - 1) / problem.visibility.times + 1; }
int horizon_height(const SweepProblem& problem) {
  const VisibilityLimit& limit = problem.visibility;
  return (limit.first_row + problem.grid.height - 1) / limit.times + 1 - first_horizon_row(limit);
}

// costs.glsl: Horizons. Empty where nothing is hidden.
std::vector<float> horizons_of(const SweepProblem& problem) {
  const VisibilityLimit& limit = problem.visibility;
  std::vector<float> lowest;
  if (!limit.any()) return lowest;
  for (int v = 0; v < static_cast<int>(problem.views.size()); ++v)
    for (int row = 0; row < horizon_height(problem); ++row)
      for (int column = 0; column < horizon_width(problem); ++column)
        lowest.push_back(
            std::max(kEverything, limit.horizons->lowest_visible(v, column, first_horizon_row(limit) + row)));
  return lowest;
}

void set_horizons(const SweepProblem& problem, Program& program) {
  const VisibilityLimit& limit = problem.visibility;
  if (!limit.any()) return;
  program.set("horizon_times", limit.times);
  program.set("horizon_first_row", limit.first_row - first_horizon_row(limit) * limit.times);
  program.set("horizon_width", horizon_width(problem));
  program.set("horizon_cells", horizon_width(problem) * horizon_height(problem));
  program.set("hidden_cost", static_cast<float>(problem.options.hidden_cost));
}

const char* number_of(Aggregation aggregation) {
  switch (aggregation) {
    case Aggregation::all_views: return "0";
    case Aggregation::better_half: return "1";
    case Aggregation::consensus: return "2";
  }
  return "";
}

// A program that follows costs.glsl, ready but for its own uniforms.
Program& cost_program(Engine& engine, const SweepProblem& problem, const std::string& file) {
  const SweepOptions& options = problem.options;
  Definitions definitions = loops(static_cast<int>(problem.views.size()), window_levels(options));
  definitions.insert(definitions.end(), {{"VIEWS", std::to_string(problem.views.size())},
                                         {"LEVELS", std::to_string(window_levels(options))},
                                         {"AGGREGATION", number_of(options.aggregation)},
                                         {"MIN_VIEWS", std::to_string(options.min_views)},
                                         {"HORIZONS", problem.visibility.any() ? "1" : "0"}});
  Program& program = engine.program({"costs.glsl", file}, definitions);
  program.set("texel_width", 1.0f / static_cast<float>(engine.photographs().texture().width()));
  program.set("texel_height", 1.0f / static_cast<float>(engine.photographs().texture().height()));
  program.set("few_views_penalty", static_cast<float>(options.few_views_penalty));
  if (options.aggregation == Aggregation::consensus)
    program.set("consensus_share", static_cast<float>(options.consensus_share));
  set_horizons(problem, program);
  return program;
}

void set_grid(const SweepProblem& problem, Program& program) {
  program.set("blocks_across", problem.block_planes.width());
  program.set("width", problem.grid.width);
  program.set("height", problem.grid.height);
}

// The layout of a problem's volume on the device.
struct Volume {
  Volume(Engine& engine, const SweepProblem& problem)
      : layout(problem),
        blocks(engine.device(), layout.blocks),
        slot_planes(engine.device(), layout.slot_planes),
        ranges(engine.device(), layout.ranges) {}
  std::size_t bytes() const { return layout.elements * sizeof(Cost); }

  VolumeLayout layout;
  Buffer blocks, slot_planes, ranges;
};

bool has_priors(const SweepProblem& problem) { return !problem.expected_plane.empty() || !problem.guide.empty(); }

// smooth.comp, refine.comp: Priors.
std::vector<std::array<std::int32_t, 4>> priors_of(const SweepProblem& problem) {
  std::vector<std::array<std::int32_t, 4>> priors;
  if (!has_priors(problem)) return priors;
  priors.assign(static_cast<std::size_t>(problem.grid.width) * problem.grid.height, {kNoPlane, 0, 0, 0});
  for (std::size_t i = 0; i < problem.expected_plane.size(); ++i) {
    const float plane = problem.expected_plane.data()[i];
    if (std::isnan(plane)) continue;
    priors[i][0] = static_cast<std::int32_t>(std::lround(plane));
    priors[i][1] = std::bit_cast<std::int32_t>(plane);
  }
  for (std::size_t i = 0; i < problem.guide.size(); ++i) priors[i][2] = problem.guide.data()[i];
  return priors;
}

Definitions prior_definitions(const SweepProblem& problem) { return {{"PRIORS", has_priors(problem) ? "1" : "0"}}; }

// What costs.glsl reads of the problem, beside the photographs.
struct Inputs {
  Inputs(Engine& engine, const SweepProblem& problem)
      : layers(engine.photographs().layers_of(problem.views)),
        geometry(engine.device(), geometry_of(problem)),
        views(engine.device(), views_of(problem, layers)),
        horizons(engine.device(), horizons_of(problem)) {}

  std::vector<int> layers;
  Buffer geometry, views, horizons;
};

// Too few views for any cost: there is nothing to compile a program for.
bool nothing_to_match(const SweepProblem& problem) {
  return static_cast<int>(problem.views.size()) < problem.options.min_views;
}

Buffer& compute_costs(Engine& engine, const SweepProblem& problem, const Volume& volume) {
  Buffer& costs = engine.scratch(Scratch::costs, volume.bytes());
  const Inputs inputs(engine, problem);
  const Buffer items(engine.device(), volume.layout.items);
  Program& program = cost_program(engine, problem, "match_costs.comp");
  set_grid(problem, program);
  program.set("item_count", static_cast<int>(volume.layout.items.size()));
  program.run(static_cast<std::int64_t>(volume.layout.items.size()),
              {&inputs.geometry, &items, &volume.blocks, &costs, &inputs.horizons}, &engine.photographs().texture(),
              &inputs.views);
  return costs;
}

// Planes from the lowest to the highest of all, rounded up so that few programs serve all problems.
int planes_in_shared_memory(const SweepProblem& problem) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(64, problem.all_planes().count()))));
}

bool fits_shared_memory(Engine& engine, const SweepProblem& problem) {
  return (2 * (planes_in_shared_memory(problem) + 2 * (kSteepestExpectedRise + 1)) + 3) *
             static_cast<int>(sizeof(int)) <=
         engine.device().limits().shared_memory_bytes;
}

Buffer& compute_sums(Engine& engine, const SweepProblem& problem, const Volume& volume, const Buffer& costs,
                     const Buffer& priors) {
  Buffer& sums = engine.scratch(Scratch::sums, volume.bytes());
  sums.fill(0);
  Definitions definitions = prior_definitions(problem);
  definitions.emplace_back("PLANES", std::to_string(planes_in_shared_memory(problem)));
  definitions.emplace_back("THREADS", "64");
  Program& program = engine.program({"smooth.comp"}, definitions);
  set_grid(problem, program);
  const Penalties penalties(problem);
  program.set("lowest_plane", problem.all_planes().first);
  program.set("small_penalty", penalties.small());
  program.set("large_penalty", penalties.large());
  if (has_priors(problem)) program.set("edge_contrast", penalties.contrast());
  const std::int64_t width = problem.grid.width, height = problem.grid.height;
  program.run(2 * height + 2 * width + 4 * (width + height - 1),
              {&volume.blocks, &volume.slot_planes, &costs, &sums, &priors});
  return sums;
}

void run_by_blocks(const SweepProblem& problem, Program& program, const std::vector<const Buffer*>& buffers) {
  set_grid(problem, program);
  program.run(static_cast<std::int64_t>(problem.block_planes.size()), buffers);
}

float cost_from(std::int32_t bits) {
  const float value = std::bit_cast<float>(bits);
  return value < kNoCost ? value : std::numeric_limits<float>::infinity();
}

float fraction_from(std::int32_t bits) {
  const float value = std::bit_cast<float>(bits);
  return value < kNoFraction ? value : std::numeric_limits<float>::quiet_NaN();
}

MatchResult matches_from(const SweepProblem& problem, const Buffer& buffer) {
  MatchResult result(problem.grid.width, problem.grid.height);
  std::vector<std::int32_t> numbers(result.plane.size() * kMatchIntegers);
  buffer.read(numbers.data(), numbers.size() * sizeof(std::int32_t));
  for (std::size_t i = 0; i < result.plane.size(); ++i) {
    const std::int32_t* of_cell = numbers.data() + i * kMatchIntegers;
    result.plane.data()[i] = of_cell[0];
    result.cost.data()[i] = cost_from(of_cell[1]);
    result.mean_cost.data()[i] = cost_from(of_cell[2]);
    result.fraction.data()[i] = fraction_from(of_cell[3]);
    result.bend.data()[i] = fraction_from(of_cell[4]);
    result.rival_plane.data()[i] = of_cell[5];
    result.rival_excess.data()[i] = cost_from(of_cell[6]);
  }
  return result;
}

MatchResult match_part(Engine& engine, const SweepProblem& problem) {
  const Volume volume(engine, problem);
  if (volume.layout.elements == 0) return {problem.grid.width, problem.grid.height};
  if (!fits_shared_memory(engine, problem))
    throw DeviceError(Trouble::out_of_memory, "The planes of a path do not fit into the GPU's shared memory.");
  const Buffer& costs = compute_costs(engine, problem, volume);
  const Buffer priors(engine.device(), priors_of(problem));
  const Buffer& sums = compute_sums(engine, problem, volume, costs, priors);
  const std::size_t cells = static_cast<std::size_t>(problem.grid.width) * problem.grid.height;
  Buffer& matches = engine.scratch(Scratch::matches, cells * kMatchIntegers * sizeof(std::int32_t));
  run_by_blocks(problem, engine.program({"best_planes.comp"}, {}),
                {&volume.blocks, &volume.slot_planes, &costs, &sums, &matches});
  if (problem.options.refinement_radius_cells > 0) {
    Program& refine = engine.program({"refine.comp"}, prior_definitions(problem));
    refine.set("radius", problem.options.refinement_radius_cells);
    run_by_blocks(problem, refine, {&volume.blocks, &volume.ranges, &costs, &matches, &priors});
  }
  return matches_from(problem, matches);
}

MatchResult winners_from(const SweepProblem& problem, const Buffer& buffer) {
  MatchResult result(problem.grid.width, problem.grid.height);
  std::vector<std::int32_t> numbers(result.plane.size() * kWinnerNumbers);
  buffer.read(numbers.data(), numbers.size() * sizeof(std::int32_t));
  for (std::size_t i = 0; i < result.plane.size(); ++i) {
    const std::int32_t* of_cell = numbers.data() + i * kWinnerNumbers;
    const float best = cost_from(of_cell[0]), sum = std::bit_cast<float>(of_cell[3]),
                seen = std::bit_cast<float>(of_cell[4]);
    if (!std::isfinite(best)) continue;
    const Parabola parabola = parabola_through(cost_from(of_cell[1]), best, cost_from(of_cell[2]));
    result.plane.data()[i] = of_cell[5];
    result.cost.data()[i] = best;
    result.mean_cost.data()[i] = sum / seen;
    result.fraction.data()[i] = static_cast<float>(parabola.vertex);
    result.bend.data()[i] = static_cast<float>(parabola.bend);
  }
  return result;
}

}  // namespace

CostVolume match_costs(const SweepProblem& problem) {
  CostVolume costs(problem, kWorstCost);
  if (nothing_to_match(problem) || costs.bytes() == 0) return costs;
  on_device([&](Engine& engine) {
    const Volume volume(engine, problem);
    compute_costs(engine, problem, volume).read(costs.cell(0, 0), costs.bytes());
  });
  return costs;
}

MatchResult match_cell_by_cell(const SweepProblem& problem) {
  if (nothing_to_match(problem)) return {problem.grid.width, problem.grid.height};
  return on_device([&](Engine& engine) {
    const VolumeLayout layout(problem);
    const Inputs inputs(engine, problem);
    const Buffer items(engine.device(), layout.items), items_of_blocks(engine.device(), layout.items_of_blocks);
    const std::size_t cells = static_cast<std::size_t>(problem.grid.width) * problem.grid.height;
    Buffer& winners = engine.scratch(Scratch::matches, cells * kWinnerNumbers * sizeof(std::int32_t));
    Program& program = cost_program(engine, problem, "match_cells.comp");
    set_grid(problem, program);
    program.set("block_count", static_cast<int>(layout.blocks.size()));
    program.run(static_cast<std::int64_t>(layout.blocks.size()),
                {&inputs.geometry, &items, &items_of_blocks, &winners, &inputs.horizons},
                &engine.photographs().texture(), &inputs.views);
    return winners_from(problem, winners);
  });
}

CostVolume smooth(const SweepProblem& problem, const CostVolume& costs) {
  CostVolume sums(problem, 0);
  if (costs.bytes() == 0) return sums;
  const bool done = on_device([&](Engine& engine) {
    if (!fits_shared_memory(engine, problem)) return false;
    const Volume volume(engine, problem);
    Buffer& given = engine.scratch(Scratch::costs, costs.bytes());
    given.write(costs.cell(0, 0), costs.bytes());
    const Buffer priors(engine.device(), priors_of(problem));
    compute_sums(engine, problem, volume, given, priors).read(sums.cell(0, 0), sums.bytes());
    return true;
  });
  return done ? sums : cpu::smooth(problem, costs);  // the same bits
}

MatchResult match_planes(const SweepProblem& problem) {
  MatchResult result(problem.grid.width, problem.grid.height);
  if (nothing_to_match(problem)) return result;
  return on_device([&](Engine& engine) {
    SweepProblem limited = problem;
    limited.options.volume_limit_mib =
        std::min(problem.options.volume_limit_mib,
                 static_cast<int>(std::min<std::int64_t>(engine.device().limits().storage_block_bytes >> 20, 1 << 20)));
    for (const Band& band : bands_within(limited)) copy_core(match_part(engine, part_of(problem, band)), band, result);
    return std::move(result);
  });
}

}  // namespace skysweep::sweep::on_gpu
