// SPDX-License-Identifier: Apache-2.0
// Every backend, the cpu on every instruction set the machine has, the gpu on its device, must find what the scalar
// double-precision reference finds: heights within 1e-3 of a plane step on 99.99 % of the cells, and a height where,
// and only where, the reference has one.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/executor.h"
#include "sweep/backend.h"
#include "sweep/heights.h"
#include "sweep/smoothing.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

PlaneSet two_ranges(PlaneRange low, PlaneRange high) {
  PlaneSet planes = low;
  planes.include(high);
  return planes;
}

using test::SyntheticProblem;

struct ContractCase {
  std::string name;
  std::function<SyntheticProblem()> make;
};

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }
double flat(double, double) { return 0.37; }

SyntheticProblem standard(int views, const test::Surface& surface,
                          const camera::CameraModel& model = test::small_camera()) {
  SyntheticProblem p = test::ring_of_views(views, model, surface);
  test::set_grid(p.problem, 80, 0.1, 0.12, -2, 2);
  return p;
}

std::vector<ContractCase> cases() {
  const auto distorted = [] {
    camera::CameraModel model = test::small_camera();
    model.distortion = {-0.3964, 0.1975, 1e-3, -2e-3, 0};
    model.cx_px += 7.3;
    return model;
  };
  return {
      {"eight_views_of_rolling_ground", [] { return standard(8, rolling); }},
      {"exposures_that_differ",
       [] {
         SyntheticProblem p = standard(4, rolling);
         for (std::size_t v = 0; v < p.problem.views.size(); ++v) {
           p.problem.views[v].gain = 0.8 + 0.15 * static_cast<double>(v);
           p.problem.views[v].offset = 3 - 4 * static_cast<double>(v);
         }
         return p;
       }},
      {"two_views", [] { return standard(2, rolling); }},
      {"thirty_two_views",
       [] {
         SyntheticProblem p = test::ring_of_views(32, test::small_camera(200, 200, 160), flat);
         test::set_grid(p.problem, 70, 0.15, 0.2, -1.5, 1.5);
         return p;
       }},
      {"better_half_aggregated",
       [] {
         SyntheticProblem p = standard(7, rolling);
         p.problem.options.aggregation = Aggregation::better_half;
         return p;
       }},
      {"all_views_aggregated",
       [] {
         SyntheticProblem p = standard(5, rolling);
         p.problem.options.aggregation = Aggregation::all_views;
         return p;
       }},
      {"single_pixels_only",
       [] {
         SyntheticProblem p = standard(6, rolling);
         p.problem.options.window_level_max = 0;
         return p;
       }},
      {"large_windows_only",
       [] {
         SyntheticProblem p = standard(6, rolling);
         p.problem.options.window_level_min = 2;
         p.problem.options.window_level_max = 6;
         return p;
       }},
      {"strong_lens_distortion", [distorted] { return standard(7, rolling, distorted()); }},
      {"lens_that_folds_inside_the_photograph",
       [] {
         camera::CameraModel model = test::small_camera(150);
         model.distortion.k1 = -0.45;
         return standard(5, flat, model);
       }},
      {"photographs_that_cover_a_part",
       [] {
         SyntheticProblem p = test::ring_of_views(6, test::small_camera(300, 121, 97), rolling, 3, 5);
         test::set_grid(p.problem, 100, 0.18, 0.12, -2, 2);
         return p;
       }},
      {"some_cells_seen_by_one_view",
       [] {
         SyntheticProblem p = test::ring_of_views(3, test::small_camera(300, 150, 90), rolling, 5, 7);
         p.problem.options.min_views = 2;
         test::set_grid(p.problem, 100, 0.2, 0.12, -2, 2);
         return p;
       }},
      {"cells_coarser_than_pixels",
       [] {
         SyntheticProblem p = standard(6, rolling);
         test::set_grid(p.problem, 65, 0.4, 0.4, -3, 3);
         int level = 0;
         for (View& view : p.problem.views) view.base_level = 1 + level++ % 2;
         return p;
       }},
      {"planes_below_and_above_the_cameras",
       [] {
         SyntheticProblem p = standard(4, flat);
         test::set_grid(p.problem, 40, 0.1, 0.5, -20, 33);
         return p;
       }},
      {"blocks_with_planes_of_their_own",
       [] {
         SyntheticProblem p = standard(6, rolling);
         p.problem.block_planes(0, 0) = PlaneRange{-3, 9};
         p.problem.block_planes(1, 1) = {};
         p.problem.block_planes(1, 0) = PlaneRange{2, 2};
         p.problem.block_planes(2, 0) = two_ranges({-4, -2}, {1, 30});
         p.problem.block_planes(0, 2) = two_ranges({-2, 2}, {4, 4});
         return p;
       }},
      {"views_hidden_by_a_known_surface",
       [] {
         SyntheticProblem p = standard(6, rolling);
         const Grid half{40, 40, 2 * p.problem.grid.cell_m, p.problem.grid.north_west_corner};
         Array2d<float> surface(40, 40, std::numeric_limits<float>::quiet_NaN());
         for (int y = 10; y < 30; ++y)
           for (int x = 15; x < 22; ++x) surface(x, y) = 2.5f;
         const Array2d<std::uint8_t> everywhere(40, 40, 1);
         SerialExecutor serial;
         p.problem.visibility = {std::make_shared<const Horizons>(
                                     half, p.problem.views, HorizonQuestion{surface, everywhere, -3, 0.1, 0}, serial),
                                 2, 0};
         p.problem.options.min_views = 3;
         return p;
       }},
      {"smoothing_along_expected_slopes",
       [] {
         SyntheticProblem p = standard(6, rolling);
         const Grid& grid = p.problem.grid;
         p.problem.expected_plane = Array2d<float>(grid.width, grid.height);
         for (int y = 0; y < grid.height; ++y) {
           for (int x = 0; x < grid.width; ++x) {
             const Vec2d cell = grid.cell_center(x, y);
             p.problem.expected_plane(x, y) =
                 x > 60 ? std::numeric_limits<float>::quiet_NaN()
                        : static_cast<float>(1.5 * rolling(cell.x, cell.y) / p.problem.dz_m + (y > 50 ? 20 : 0));
           }
         }
         return p;
       }},
      {"oblique_views",
       [] {
         SyntheticProblem p;
         for (int i = 0; i < 5; ++i) {
           const double yaw = 60 * i;
           const double s = std::sin(yaw * 0.0174532925199433), c = std::cos(yaw * 0.0174532925199433);
           p.add_view(test::small_camera(), {camera::rotation_from_yaw_pitch_roll(yaw, -50, 3), {-25 * s, -25 * c, 30}},
                      flat);
         }
         test::set_grid(p.problem, 100, 0.12, 0.15, -2, 2);
         return p;
       }},
  };
}

// Cells whose cost differs by more than 2e-3 grey levels.
std::size_t cells_with_other_costs(const MatchResult& expected, const MatchResult& actual) {
  std::size_t bad = 0;
  for (std::size_t i = 0; i < expected.cost.size(); ++i) {
    const float e = expected.cost.data()[i], a = actual.cost.data()[i];
    if (std::isinf(e) && std::isinf(a)) continue;
    if (!(std::abs(e - a) <= 2e-3f)) ++bad;
  }
  return bad;
}

// What two backends made of the same cells.
struct Agreement {
  std::size_t cells = 0, with_height = 0, different = 0, presence_differs = 0;
};

void compare(const SweepProblem& problem, const MatchResult& expected, const MatchResult& actual, Agreement& sum) {
  const Heights a = heights_from_matches(problem, expected), b = heights_from_matches(problem, actual);
  for (std::size_t i = 0; i < a.height_m.size(); ++i) {
    const float ha = a.height_m.data()[i], hb = b.height_m.data()[i];
    ++sum.cells;
    if (std::isnan(ha) != std::isnan(hb)) ++sum.presence_differs;
    if (std::isnan(ha) || std::isnan(hb)) continue;
    ++sum.with_height;
    // Single precision of the stored height itself is below this bound.
    if (std::abs(ha - hb) > 1e-3 * problem.dz_m) ++sum.different;
  }
}

// A backend as it is tried: the cpu once on each instruction set.
struct Candidate {
  std::string name;
  Backend backend;
};

std::optional<std::string> why_no_gpu() {
  try {
    gpu_device();
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  }
}

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const std::string& name : cpu_instruction_sets()) all.push_back({name, Backend::cpu});
  if (!why_no_gpu()) all.push_back({"gpu", Backend::gpu});
  return all;
}

// Makes ready for the candidate; what the GPU leaves to the cpu is a failure here.
void use(const Candidate& candidate) {
  if (candidate.backend == Backend::gpu) {
    listen_to_gpu_trouble([](const std::string& sentence) { ADD_FAILURE() << sentence; });
    return;
  }
  use_cpu_instruction_set(candidate.name);
  EXPECT_EQ(cpu_instruction_set_in_use(), candidate.name);
}

// Runs all cases once through the reference and once through every candidate, with or without smoothing.
std::map<std::string, Agreement> agreement_with_reference(
    const std::function<MatchResult(const SweepProblem&, Backend)>& match) {
  std::map<std::string, Agreement> agreements;
  for (const ContractCase& c : cases()) {
    const SyntheticProblem p = c.make();
    p.problem.check();
    const MatchResult expected = match(p.problem, Backend::reference);
    for (const Candidate& candidate : candidates()) {
      use(candidate);
      const std::string& name = candidate.name;
      const MatchResult actual = match(p.problem, candidate.backend);
      Agreement here;
      compare(p.problem, expected, actual, here);
      EXPECT_LE(here.different, here.cells / 1000) << c.name << " on " << name;
      EXPECT_LE(cells_with_other_costs(expected, actual), here.cells / 1000) << c.name << " on " << name;
      Agreement& sum = agreements[name];
      sum.cells += here.cells;
      sum.with_height += here.with_height;
      sum.different += here.different;
      sum.presence_differs += here.presence_differs;
    }
  }
  use_cpu_instruction_set(cpu_instruction_sets().front());
  return agreements;
}

void expect_the_bound(const std::map<std::string, Agreement>& agreements) {
  for (const auto& [name, sum] : agreements) {
    EXPECT_GT(sum.with_height, sum.cells / 3) << name << ": the cases must have something to compare";
    EXPECT_LE(sum.different, sum.with_height / 10000) << name << ": of " << sum.with_height;
    EXPECT_LE(sum.presence_differs, sum.cells / 10000) << name << ": of " << sum.cells;
    testing::Test::RecordProperty(name + "_cells_beyond_the_bound", std::to_string(sum.different));
    testing::Test::RecordProperty(name + "_cells_with_height", std::to_string(sum.with_height));
  }
}

TEST(MatchingContract, cell_by_cell) {
  SerialExecutor serial;
  expect_the_bound(agreement_with_reference(
      [&](const SweepProblem& problem, Backend backend) { return match_cell_by_cell(problem, backend, serial); }));
}

TEST(MatchingContract, with_smoothing) {
  SerialExecutor serial;
  expect_the_bound(agreement_with_reference(
      [&](const SweepProblem& problem, Backend backend) { return match_planes(problem, backend, serial); }));
}

// Whole numbers: the sums of the paths are the same bit for bit.
TEST(MatchingContract, smoothing_is_exact) {
  Random random(7);
  SweepProblem problem;
  problem.grid = {150, 90, 1, {0, 0}};
  problem.search_everywhere({});
  const std::vector<PlaneSet> sets = {
      PlaneRange{-7, 40},
      PlaneRange{10, 11},
      PlaneRange{-60, -20},  // no plane in common with the one before
      PlaneRange{0, 31},
      {},  // paths break off here
      PlaneRange{-100, 60},
      two_ranges({-30, -10}, {-8, 20}),  // nearer to each other than a vector is wide
      two_ranges({-90, -60}, {12, 12}),
  };
  for (PlaneSet& planes : problem.block_planes) planes = sets[random.below(sets.size())];
  CostVolume costs(problem, 0);
  for (int y = 0; y < problem.grid.height; ++y)
    for (int x = 0; x < problem.grid.width; ++x)
      for_each_stored_range(costs.planes_at(x, y), [&](StoredRange range) {
        for (int i = 0; i < range.planes.count(); ++i)
          costs.cell(x, y)[range.slot + i] =
              random.below(9) == 0 ? kWorstCost : static_cast<Cost>(random.below(kWorstCost));
      });
  for (const double large : {0.0, 8.0, 60.0}) {
    // The last time along slopes, some of them too steep to be followed, and with cheaper steps at edges.
    if (large == 60) {
      problem.expected_plane = Array2d<float>(problem.grid.width, problem.grid.height);
      for (float& plane : problem.expected_plane) plane = 0.5f * static_cast<float>(random.below(20));
      problem.guide = Array2d<std::uint8_t>(problem.grid.width, problem.grid.height);
      for (std::uint8_t& grey : problem.guide) grey = static_cast<std::uint8_t>(random.below(100));
    }
    problem.options.small_step_penalty = large / 8;
    problem.options.large_step_penalty = large;
    const CostVolume expected = smooth(problem, costs, Backend::reference);
    for (const Candidate& candidate : candidates()) {
      use(candidate);
      EXPECT_TRUE(expected == smooth(problem, costs, candidate.backend)) << candidate.name << ", P2 = " << large;
    }
  }
  use_cpu_instruction_set(cpu_instruction_sets().front());
}

void keep_corner(SweepProblem& problem, int cells) {
  problem.grid.width = problem.grid.height = cells;
  problem.block_planes = crop(problem.block_planes, 0, 0, blocks_across(cells), blocks_across(cells));
}

// The costs themselves: below 2e-3 grey levels apart, but where a view's border or fold runs through the cell.
TEST(MatchingContract, costs) {
  SerialExecutor serial;
  for (const ContractCase& c : cases()) {
    if (c.name == "thirty_two_views") continue;  // slow in the reference, and covered above
    SyntheticProblem p = c.make();
    keep_corner(p.problem, 34);
    const CostVolume expected = match_costs(p.problem, Backend::reference, serial);
    for (const Candidate& candidate : candidates()) {
      use(candidate);
      const CostVolume actual = match_costs(p.problem, candidate.backend, serial);
      std::size_t bad = 0, values = 0;
      for (int y = 0; y < expected.height(); ++y)
        for (int x = 0; x < expected.width(); ++x)
          for (int i = 0; i < CostVolume::padded_planes(expected.planes_at(x, y)); ++i, ++values)
            bad += std::abs(expected.cell(x, y)[i] - actual.cell(x, y)[i]) > 2e-3 * kCostScale;
      EXPECT_LE(bad, values / 10000) << c.name << " on " << candidate.name << " of " << values;
    }
  }
  use_cpu_instruction_set(cpu_instruction_sets().front());
}

// Whether the cases above ran on a GPU.
TEST(MatchingContract, has_a_gpu) {
  if (const auto reason = why_no_gpu()) GTEST_SKIP() << *reason;
  EXPECT_FALSE(gpu_device().name.empty());
}

TEST(Backends, unknown_instruction_set_is_refused) { EXPECT_THROW(use_cpu_instruction_set("AVX9"), Error); }

}  // namespace
}  // namespace skysweep::sweep
