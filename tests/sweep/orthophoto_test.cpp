// SPDX-License-Identifier: Apache-2.0
#include "sweep/orthophoto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sweep/linear_light.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

double rolling(double x, double y) { return 0.8 * std::sin(x / 3) + 0.6 * std::cos(y / 4); }

Rgb8 exposed(Rgb8 c, const std::array<double, 3>& gain) {
  return {encoded_light(static_cast<float>(linear_light(c.r) * gain[0])),
          encoded_light(static_cast<float>(linear_light(c.g) * gain[1])),
          encoded_light(static_cast<float>(linear_light(c.b) * gain[2]))};
}

using Gain = std::array<double, 3>;  // on linear light
using Disturb = std::function<Rgb8(int view, int column, int row, Rgb8 color)>;

// Six cameras above rolling ground and what they show, made once: 96 x 96 cells of 0.1 m.
struct Flight {
  test::SyntheticProblem views = test::ring_of_views(6, test::small_camera(220, 200, 160), rolling);
  std::vector<Array2d<Rgb8>> photographs;
  Flight() {
    for (const View& view : views.problem.views) photographs.push_back(test::photograph_of(view.camera, rolling));
  }
};

// Its views after their pixels have gone through `disturb`.
test::SyntheticProblem views_of_ground(const Disturb& disturb) {
  static const Flight flight;
  test::SyntheticProblem p;
  for (int v = 0; v < 6; ++v) {
    Array2d<Rgb8> photograph = flight.photographs[v];
    for (int y = 0; y < photograph.height(); ++y)
      for (int x = 0; x < photograph.width(); ++x) photograph(x, y) = disturb(v, x, y, photograph(x, y));
    p.images.emplace_back(std::move(photograph));
    p.problem.views.push_back({&p.images.back(), flight.views.problem.views[v].camera, 0});
  }
  test::set_grid(p.problem, 96, 0.1, 0.1, -2.5, 2.5);
  return p;
}

Disturb gains(const std::vector<Gain>& of_views) {
  return [of_views](int v, int, int, Rgb8 c) { return exposed(c, of_views[v % of_views.size()]); };
}

Disturb noise(int most = 4) {
  return [most](int v, int x, int y, Rgb8 c) {
    const int error = static_cast<int>(mix64(mix64(1000 * v + x) + y) % (2 * most + 1)) - most;
    const auto with = [error](std::uint8_t value) {
      return static_cast<std::uint8_t>(std::clamp(value + error, 0, 255));
    };
    return Rgb8{with(c.r), with(c.g), with(c.b)};
  };
}

const std::vector<Gain> kHalfAStop = {{0.7, 0.7, 0.7}, {1.4, 1.4, 1.4}, {1.05, 1.05, 1.05}, {0.85, 0.85, 0.85}};

SweepResult colored(const SweepProblem& problem) {
  SweepResult result;
  result.height_m = Array2d<float>(problem.grid.width, problem.grid.height);
  for (int y = 0; y < problem.grid.height; ++y)
    for (int x = 0; x < problem.grid.width; ++x) {
      const Vec2d cell = problem.grid.cell_center(x, y);
      result.height_m(x, y) = static_cast<float>(rolling(cell.x, cell.y));
    }
  SerialExecutor serial;
  colorize(problem, serial, result);
  return result;
}

// Calls visit(a, b) with the values of every two cells of the core side by side.
template <typename Visit>
void for_each_pair(const SweepProblem& problem, Visit visit) {
  const int first = problem.collar_cells, last = problem.grid.width - problem.collar_cells;
  for (int y = first; y < last; ++y)
    for (int x = first; x + 1 < last; ++x) visit(x, y);
}

// By how much the error of green jumps from a cell to the next, mean over those from different views.
double seam_height(const SweepProblem& problem, const SweepResult& result) {
  const auto error = [&](int x, int y) {
    const Vec2d cell = problem.grid.cell_center(x, y);
    return result.color(x, y).g - test::ground_texture(cell.x, cell.y);
  };
  double sum = 0;
  int seams = 0;
  for_each_pair(problem, [&](int x, int y) {
    if (result.color_view(x, y) == result.color_view(x + 1, y)) return;
    sum += std::abs(error(x + 1, y) - error(x, y));
    ++seams;
  });
  EXPECT_GT(seams, 20);
  return sum / seams;
}

int seam_length(const SweepProblem& problem, const SweepResult& result) {
  int seams = 0;
  for_each_pair(problem, [&](int x, int y) { seams += result.color_view(x, y) != result.color_view(x + 1, y); });
  return seams;
}

double median_color_error(const SweepProblem& problem, const SweepResult& result) {
  std::vector<double> errors;
  for_each_pair(problem, [&](int x, int y) {
    const Vec2d cell = problem.grid.cell_center(x, y);
    errors.push_back(std::abs(result.color(x, y).g - test::ground_texture(cell.x, cell.y)));
  });
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

TEST(Orthophoto, photographs_of_equal_exposure_keep_every_byte) {
  test::SyntheticProblem p = views_of_ground(noise());
  const SweepResult compensated = colored(p.problem);
  p.problem.options.compensate_exposure = false;
  EXPECT_EQ(compensated.color, colored(p.problem).color);
}

TEST(Orthophoto, seams_between_different_exposures_do_not_show) {
  test::SyntheticProblem p = views_of_ground(gains(kHalfAStop));
  const double compensated = seam_height(p.problem, colored(p.problem));
  p.problem.options.compensate_exposure = false;
  const double as_photographed = seam_height(p.problem, colored(p.problem));
  const double equal = seam_height(p.problem, colored(views_of_ground(gains({{1, 1, 1}})).problem));
  EXPECT_GT(as_photographed, equal + 6);
  EXPECT_LT(compensated, equal + 1);
}

TEST(Orthophoto, white_balance_is_made_equal_channel_by_channel) {
  test::SyntheticProblem p = views_of_ground(gains({{1.2, 1, 0.85}, {0.85, 1, 1.2}}));
  const auto color_casts = [&] {
    const SweepResult result = colored(p.problem);
    double sum = 0;
    for_each_pair(p.problem, [&](int x, int y) {
      const Rgba8 a = result.color(x, y), b = result.color(x + 1, y);
      if (result.color_view(x, y) != result.color_view(x + 1, y)) sum += std::abs((a.r - a.b) - (b.r - b.b));
    });
    return sum;
  };
  const double compensated = color_casts();
  p.problem.options.compensate_exposure = false;
  EXPECT_LT(5 * compensated, color_casts());
}

TEST(Orthophoto, neighbouring_cells_prefer_the_same_view) {
  test::SyntheticProblem p = views_of_ground(noise(20));
  const int together = seam_length(p.problem, colored(p.problem));
  p.problem.options.seam_cost = 0;
  EXPECT_LT(2 * together, seam_length(p.problem, colored(p.problem)));
}

TEST(Orthophoto, mean_has_less_noise) {
  test::SyntheticProblem p = views_of_ground(noise());
  const double best = median_color_error(p.problem, colored(p.problem));
  p.problem.options.orthophoto = Orthophoto::mean;
  EXPECT_LT(median_color_error(p.problem, colored(p.problem)), 0.8 * best);
}

// Something large and white that only one photograph shows.
TEST(Orthophoto, what_only_one_view_shows_is_in_neither_orthophoto) {
  for (const Orthophoto kind : {Orthophoto::best, Orthophoto::mean}) {
    for (int with = 0; with < 6; ++with) {
      test::SyntheticProblem p = views_of_ground([with](int v, int x, int y, Rgb8 c) {
        const bool passing = v == with && std::abs(x - 100) < 20 && std::abs(y - 80) < 20;
        return passing ? Rgb8{255, 255, 255} : c;
      });
      p.problem.options.orthophoto = kind;
      const SweepResult result = colored(p.problem);
      int white = 0;
      for (const Rgba8 c : result.color) white += c.g > 245;
      EXPECT_LE(white, 5) << "view " << with;
    }
  }
}

// Two tiles side by side, and one that covers what both do: the same colours at the common border.
TEST(Orthophoto, neighbouring_tiles_agree_at_their_border) {
  test::SyntheticProblem p = views_of_ground(gains(kHalfAStop));
  SweepProblem whole = p.problem;
  whole.collar_cells = 16;  // core: columns 16 to 79
  const auto part = [&](int first_column) {
    SweepProblem tile = whole;
    tile.grid.width = 64;
    tile.grid.north_west_corner.x += first_column * tile.grid.cell_m;
    tile.search_everywhere(whole.all_planes());
    return colored(tile);
  };
  const SweepResult west = part(0), east = part(32), both = colored(whole);
  int different = 0, cells = 0;
  for (int y = 16; y < 80; ++y) {
    for (int x = 44; x < 52; ++x) {
      const Rgba8 tile = x < 48 ? west.color(x, y) : east.color(x - 32, y), one = both.color(x, y);
      ++cells;
      different += std::abs(tile.r - one.r) > 1 || std::abs(tile.g - one.g) > 1 || std::abs(tile.b - one.b) > 1;
    }
  }
  EXPECT_LE(different, cells / 50);
}

TEST(Orthophoto, wrong_settings_are_refused_with_a_sentence) {
  SweepOptions options;
  for (const double cost : {-1.0, 61.0, std::nan("")}) {
    options.seam_cost = cost;
    EXPECT_EQ(options.problem().value_or(""), "seam_cost must lie between 0 (off) and 60 grey levels");
  }
}

}  // namespace
}  // namespace skysweep::sweep
