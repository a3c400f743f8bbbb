// SPDX-License-Identifier: Apache-2.0
#include "sweep/step_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sweep/hidden_cells.h"
#include "sweep/point_colors.h"
#include "sweep/surface_fit.h"
#include "sweep/visibility.h"

namespace skysweep::sweep {
namespace {

constexpr double kStepPlanes = 3;    // between neighbouring cells: more is a step,
constexpr double kSteepestRoof = 2;  // if it is also steeper, metres a metre, than roofs are
double smallest_step(const SweepProblem& problem) {
  return std::max(kStepPlanes * problem.dz_m, kSteepestRoof * problem.grid.cell_m);
}
constexpr int kMostSurfaces = 4;  // that a cell may choose from
// All differences of colour are counted in units of the one that is usual where the surface is known. Beyond this,
// colours are of different things, and how far apart they are says nothing.
constexpr double kLargestDifference = 5;
// Two views agree by chance too easily: what fewer see costs as much as what none sees.
constexpr int kFewestWitnesses = 3;
constexpr double kFewWitnessesPenalty = 2;  // divided by the number of views that see the place
// Neighbours whose colours differ by so much belong together half as much, and never less than a share.
constexpr double kContrast = 2.5, kLeastWeight = 0.2;
constexpr double kDiagonalWeight = 0.7;
// A difference of so many cells' height is a step in full, a smaller one in part: a steep face made of many small steps
// costs what one large step would, and the colours decide.
constexpr double kFullStepCells = 7;
// A gap is closed where the views agree so well, in units of the usual difference.
constexpr double kAgreement = 2.5;
// A surface is looked at so far from the middle of the cell, cells, towards its side: pixels on an edge are mixed.
constexpr double kInwards = 0.45;
constexpr int kRoundsOfChoice = 4;
// Where so large a share of the cells within so many columns and rows lies at steps, as in the crowns of trees, no step
// is an edge.
constexpr double kRubbleShare = 0.8;
constexpr int kRubbleReach = 8;

struct Direction {
  int x, y;
};
constexpr std::array<Direction, 8> kDirections{{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr double kAllWeights = 4 + 4 * kDiagonalWeight;

// A surface that may be the one in a cell: its height there, and what speaks for it.
struct Surface {
  float z = 0, sigma = 0;
  float cost = 0;        // in units of the usual difference, as is
  float difference = 0;  // how much those views differ that see it
  MeanColor color{};
  int seen_by = 0;
};

struct EdgeCell {
  int column = 0, row = 0;
  int count = 0, chosen = 0;
  std::array<Surface, kMostSurfaces> of{};

  bool add(float z, float sigma, double alike_m) {
    if (count == kMostSurfaces) return false;
    for (int i = 0; i < count; ++i)
      if (std::abs(of[i].z - z) <= alike_m) return false;
    of[count++] = {z, sigma};
    return true;
  }
  const Surface& surface() const { return of[chosen]; }
  float lowest_m() const {
    float lowest = of[0].z;
    for (int i = 1; i < count; ++i) lowest = std::min(lowest, of[i].z);
    return lowest;
  }
};

// All cells at most `reach` columns and rows from a marked one.
Array2d<std::uint8_t> around(const Array2d<std::uint8_t>& marked, int reach) {
  const int width = marked.width(), height = marked.height();
  Array2d<std::uint8_t> across(width, height, 0), out(width, height, 0);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      if (marked(column, row) != 0)
        std::fill(across.row(row) + std::max(0, column - reach), across.row(row) + std::min(width, column + reach + 1),
                  std::uint8_t{1});
  for (int row = 0; row < height; ++row)
    for (int y = std::max(0, row - reach); y < std::min(height, row + reach + 1); ++y)
      for (int column = 0; column < width; ++column) out(column, y) |= across(column, row);
  return out;
}

// Sums over the columns left of and the rows above each corner of the cells.
Array2d<int> summed(const Array2d<std::uint8_t>& marked) {
  Array2d<int> sums(marked.width() + 1, marked.height() + 1, 0);
  for (int row = 0; row < marked.height(); ++row)
    for (int column = 0; column < marked.width(); ++column)
      sums(column + 1, row + 1) =
          sums(column, row + 1) + sums(column + 1, row) - sums(column, row) + marked(column, row);
  return sums;
}

// Takes the marks off where there is hardly anything but steps.
void drop_rubble(const Array2d<std::uint8_t>& at_steps, Array2d<std::uint8_t>& marked) {
  const int width = at_steps.width(), height = at_steps.height();
  const Array2d<int> sums = summed(at_steps);
  Array2d<std::uint8_t> rubble(width, height, 0);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      if (at_steps(column, row) == 0) continue;
      const int left = std::max(0, column - kRubbleReach), right = std::min(width, column + kRubbleReach + 1);
      const int top = std::max(0, row - kRubbleReach), bottom = std::min(height, row + kRubbleReach + 1);
      const int steps = sums(right, bottom) - sums(left, bottom) - sums(right, top) + sums(left, top);
      rubble(column, row) = steps > kRubbleShare * (right - left) * (bottom - top);
    }
  }
  const Array2d<std::uint8_t> all = around(rubble, kRubbleReach);
  for (std::size_t i = 0; i < marked.size(); ++i) marked.data()[i] &= !all.data()[i];
}

// One pass over the steps of a surface.
class EdgePass {
 public:
  // `usual_difference`: of the colours in which views show one place, grey levels.
  EdgePass(const SweepProblem& problem, double usual_difference, Executor& executor, Heights& heights,
           EdgeEvidence& evidence)
      : problem_(problem),
        usual_difference_(usual_difference),
        executor_(executor),
        heights_(heights),
        evidence_(evidence),
        alike_m_(0.5 * kStepPlanes * problem.dz_m),
        searched_(problem.all_planes()),
        cell_at_(problem.grid.width, problem.grid.height, -1) {}

  // `active`: the cells to look at; afterwards those around which something changed.
  void run(Array2d<std::uint8_t>& active) {
    gather(near_steps(active));
    judge();
    for (int round = 0; round < kRoundsOfChoice; ++round)
      for (int parity = 0; parity < 4; ++parity) choose(parity);
    weigh();
    active = settle();
  }

 private:
  bool is_step(int column, int row, int x, int y) const {
    const Array2d<float>& z = heights_.height_m;
    return z.contains(x, y) && std::abs(z(column, row) - z(x, y)) > smallest_step(problem_);
  }

  Array2d<std::uint8_t> near_steps(const Array2d<std::uint8_t>& active) const {
    const int width = active.width(), height = active.height();
    Array2d<std::uint8_t> at_steps(width, height, 0);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        if (is_step(column, row, column + 1, row)) at_steps(column, row) = at_steps(column + 1, row) = 1;
        if (is_step(column, row, column, row + 1)) at_steps(column, row) = at_steps(column, row + 1) = 1;
      }
    }
    Array2d<std::uint8_t> near = around(at_steps, problem_.options.edge_reach_cells);
    for (std::size_t i = 0; i < near.size(); ++i) near.data()[i] &= active.data()[i];
    drop_rubble(at_steps, near);
    return near;
  }

  // The heights that the surfaces around have in a cell: its own first, then from afar, where edges disturb less.
  EdgeCell surfaces_around(int column, int row) const {
    const Array2d<float>& z = heights_.height_m;
    EdgeCell cell;
    cell.column = column, cell.row = row;
    if (!std::isnan(z(column, row))) cell.add(z(column, row), heights_.sigma_m(column, row), alike_m_);
    for (int distance = problem_.options.edge_reach_cells + 1; distance >= 1; --distance) {
      for (const Direction d : kDirections) {
        const int x = column + distance * d.x, y = row + distance * d.y;
        if (!z.contains(x, y) || std::isnan(z(x, y))) continue;
        float height = z(x, y);
        const int beyond_x = x + 2 * d.x, beyond_y = y + 2 * d.y;
        if (z.contains(beyond_x, beyond_y)) {
          const float rise = (height - z(beyond_x, beyond_y)) / 2;                                   // a cell
          if (std::abs(rise) < problem_.grid.cell_m) height += static_cast<float>(distance) * rise;  // not of NaN
        }
        if (is_searched(height)) cell.add(height, heights_.sigma_m(x, y), alike_m_);
      }
    }
    return cell;
  }

  // Surfaces that rise out of what was searched are no surfaces.
  bool is_searched(double z) const {
    return z >= (searched_.first - 0.5) * problem_.dz_m && z <= (searched_.last + 0.5) * problem_.dz_m;
  }

  void gather(const Array2d<std::uint8_t>& near) {
    for (int row = 0; row < near.height(); ++row) {
      for (int column = 0; column < near.width(); ++column) {
        if (!near(column, row)) continue;
        const EdgeCell cell = surfaces_around(column, row);
        if (cell.count > 1 || (cell.count == 1 && std::isnan(heights_.height_m(column, row)))) put(cell);
      }
    }
    // Their neighbours have nothing to choose, but their colours matter.
    for (std::size_t i = 0, open = cells_.size(); i < open; ++i) {
      for (const Direction d : kDirections) {
        const int column = cells_[i].column + d.x, row = cells_[i].row + d.y;
        if (!cell_at_.contains(column, row) || cell_at_(column, row) >= 0) continue;
        EdgeCell cell;
        cell.column = column, cell.row = row;
        if (std::isnan(heights_.height_m(column, row))) continue;
        cell.add(heights_.height_m(column, row), heights_.sigma_m(column, row), alike_m_);
        put(cell);
      }
    }
  }

  template <typename Work>
  void for_each(int count, Work work) const {
    constexpr int kTogether = 64;
    executor_.parallel_for((count + kTogether - 1) / kTogether, [&](int part) {
      for (int i = part * kTogether; i < std::min(count, (part + 1) * kTogether); ++i) work(i);
    });
  }

  void put(const EdgeCell& cell) {
    const int at = static_cast<int>(cells_.size());
    cell_at_(cell.column, cell.row) = at;
    if (cell.count > 1) of_parity_[2 * (cell.row & 1) + (cell.column & 1)].push_back(at);
    cells_.push_back(cell);
  }

  // From the middle of a cell towards its neighbours on a surface, metres east and north.
  Vec2d inwards(const EdgeCell& cell, const Surface& s) const {
    Vec2d sum;
    for (const Direction d : kDirections) {
      const int x = cell.column + d.x, y = cell.row + d.y;
      if (!heights_.height_m.contains(x, y)) continue;
      if (!(std::abs(heights_.height_m(x, y) - s.z) <= alike_m_ + problem_.grid.cell_m)) continue;
      sum = sum + (1 / std::hypot(d.x, d.y)) * Vec2d{double(d.x), double(-d.y)};
    }
    const double length = norm(sum);
    return length > 0.5 ? kInwards * problem_.grid.cell_m / length * sum : Vec2d{};
  }

  void judge() {
    const SurfaceVisibility visibility(problem_.grid, heights_.height_m, kOcclusionTolerancePlanes * problem_.dz_m);
    const double hidden_cost = problem_.options.edge_hidden_cost;
    for_each(static_cast<int>(cells_.size()), [&](int i) {
      EdgeCell& cell = cells_[i];
      CellSight sight(problem_, visibility, cell.column, cell.row, cell.lowest_m());
      for (int k = 0; k < cell.count; ++k) {
        Surface& s = cell.of[k];
        const PointColors seen =
            point_colors(problem_, sight, s.z, kLargestDifference * usual_difference_, inwards(cell, s));
        s.color = seen.median;
        s.seen_by = seen.seen_by;
        const int n = seen.seen_by;
        s.cost = static_cast<float>(hidden_cost);
        if (n < kFewestWitnesses) continue;
        const double own = seen.spread / usual_difference_ * n / (n - 1) + kFewWitnessesPenalty / n;
        s.difference = static_cast<float>(own);
        s.cost = static_cast<float>((n * own + seen.hidden_from * hidden_cost) / (n + seen.hidden_from));
      }
    });
  }

  // What it costs a cell to be on a surface that its neighbours are not on.
  double disagreement(const EdgeCell& cell, const Surface& s) const {
    double sum = 0;
    for (const Direction d : kDirections) {
      const int x = cell.column + d.x, y = cell.row + d.y;
      if (!cell_at_.contains(x, y)) continue;
      const EdgeCell* other = cell_at_(x, y) >= 0 ? &cells_[cell_at_(x, y)] : nullptr;
      const float z = other ? other->surface().z : heights_.height_m(x, y);
      const double step_m = std::abs(z - s.z);
      if (!(step_m > alike_m_ + problem_.grid.cell_m)) continue;  // of NaN, too
      double weight = d.x != 0 && d.y != 0 ? kDiagonalWeight : 1;
      weight *= std::min(1.0, step_m / (kFullStepCells * problem_.grid.cell_m));
      if (other) {
        const double contrast = color_difference(other->surface().color, s.color) / (kContrast * usual_difference_);
        weight *= std::max(kLeastWeight, 1 / (1 + contrast * contrast));
      }
      sum += weight;
    }
    return sum / kAllWeights;
  }

  double total_cost(const EdgeCell& cell, const Surface& s) const {
    return s.cost + problem_.options.edge_penalty * disagreement(cell, s);
  }

  // All cells of one of the four colours: none is another's neighbour.
  void choose(int parity) {
    const std::vector<int>& members = of_parity_[parity];
    for_each(static_cast<int>(members.size()), [&](int m) {
      EdgeCell& cell = cells_[members[m]];
      int best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < cell.count; ++i) {
        const double cost = total_cost(cell, cell.of[i]);
        if (cost < least) least = cost, best = i;
      }
      cell.chosen = best;
    });
  }

  void weigh() {
    for (const EdgeCell& cell : cells_) {
      if (cell.count < 2) continue;
      double next = std::numeric_limits<double>::infinity();
      for (int i = 0; i < cell.count; ++i)
        if (i != cell.chosen) next = std::min(next, total_cost(cell, cell.of[i]));
      evidence_.margin(cell.column, cell.row) = static_cast<float>(next - total_cost(cell, cell.surface()));
      evidence_.difference(cell.column, cell.row) = cell.surface().difference;
    }
  }

  // Writes the new heights; returns the cells around them.
  Array2d<std::uint8_t> settle() {
    Array2d<std::uint8_t> changed(problem_.grid.width, problem_.grid.height, 0);
    for (const EdgeCell& cell : cells_) {
      const float before = heights_.height_m(cell.column, cell.row);
      const Surface& s = cell.surface();
      const bool is_seen = s.seen_by >= problem_.options.min_views && s.difference <= kAgreement;
      if (std::isnan(before) ? !is_seen : cell.chosen == 0) continue;
      changed(cell.column, cell.row) = 1;
    }
    const SurfaceFit surface{problem_.grid.cell_m, alike_m_};
    std::vector<float> z(cells_.size());
    for_each(static_cast<int>(cells_.size()), [&](int i) {
      const EdgeCell& cell = cells_[i];
      if (!changed(cell.column, cell.row)) return;
      const double rough = cell.surface().z;
      const double fitted = fitted_height(heights_, changed, surface, cell.column, cell.row, rough).value_or(rough);
      z[i] = static_cast<float>(is_searched(fitted) ? fitted : rough);
    });
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const EdgeCell& cell = cells_[i];
      if (!changed(cell.column, cell.row)) continue;
      heights_.height_m(cell.column, cell.row) = z[i];
      heights_.sigma_m(cell.column, cell.row) = cell.surface().sigma;
    }
    return around(changed, problem_.options.edge_reach_cells + 1);
  }

  const SweepProblem& problem_;
  double usual_difference_;
  Executor& executor_;
  Heights& heights_;
  EdgeEvidence& evidence_;
  double alike_m_;  // heights that differ by less are of the same surface
  PlaneRange searched_;
  Array2d<int> cell_at_;
  std::vector<EdgeCell> cells_;
  std::array<std::vector<int>, 4> of_parity_;  // those that have a choice, by the colour of a chequerboard of four
};

// The median difference between the colours in which views show a place, over places whose height is known and far from
// steps: noise, exposure, texture and poses together. Nothing where too few are.
std::optional<double> usual_difference(const SweepProblem& problem, const Heights& heights, Executor& executor) {
  constexpr int kEvery = 8, kFewestPlaces = 32;
  constexpr double kAnyDifference = 255;
  const Array2d<float>& z = heights.height_m;
  const SurfaceVisibility visibility(problem.grid, z, kOcclusionTolerancePlanes * problem.dz_m);
  const auto level = [&](int column, int row) {
    for (int y = row - 1; y <= row + 1; ++y)
      for (int x = column - 1; x <= column + 1; ++x)
        if (!(std::abs(z(x, y) - z(column, row)) <= kStepPlanes * problem.dz_m)) return false;  // of NaN, too
    return true;
  };
  const int rows = std::max(0, (problem.grid.height - 2) / kEvery);
  std::vector<std::vector<double>> of_row(rows);
  executor.parallel_for(rows, [&](int i) {
    const int row = 1 + i * kEvery;
    for (int column = 1; column + 1 < problem.grid.width; column += kEvery) {
      if (!level(column, row)) continue;
      CellSight sight(problem, visibility, column, row, z(column, row));
      const PointColors seen = point_colors(problem, sight, z(column, row), kAnyDifference);
      if (seen.seen_by >= kFewestWitnesses) of_row[i].push_back(seen.spread * seen.seen_by / (seen.seen_by - 1));
    }
  });
  std::vector<double> all;
  for (const std::vector<double>& row : of_row) all.insert(all.end(), row.begin(), row.end());
  if (all.size() < kFewestPlaces) return std::nullopt;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  constexpr double kLeast = 1.5;  // pixels on an edge are mixed, however little noise there is
  return std::max(kLeast, *middle);
}

}  // namespace

EdgeEvidence settle_edges(const SweepProblem& problem, Executor& executor, Heights& heights) {
  EdgeEvidence evidence;
  if (problem.options.edge_passes == 0) return evidence;
  const std::optional<double> usual = usual_difference(problem, heights, executor);
  if (!usual) return evidence;
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  evidence.margin = evidence.difference = Array2d<float>(problem.grid.width, problem.grid.height, kNone);
  Array2d<std::uint8_t> active(problem.grid.width, problem.grid.height, 1);
  for (int pass = 0; pass < problem.options.edge_passes; ++pass)
    EdgePass(problem, *usual, executor, heights, evidence).run(active);
  return evidence;
}

}  // namespace skysweep::sweep
