// SPDX-License-Identifier: Apache-2.0
#include "report/height_edges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "report/distance_transform.h"

namespace skysweep::report {
namespace {

double share(std::int64_t count, std::int64_t all) {
  return all > 0 ? static_cast<double>(count) / static_cast<double>(all) : std::numeric_limits<double>::quiet_NaN();
}

// Squared distance, in half cells, from every corner, side and centre to the nearest of the edges.
Array2d<float> squared_distance_to_edges(const std::vector<HeightEdge>& edges, int width, int height) {
  Array2d<std::uint8_t> marked(std::max(0, 2 * width - 1), std::max(0, 2 * height - 1));
  for (const HeightEdge& edge : edges) marked(edge.x_half_cells(), edge.y_half_cells()) = 1;
  return squared_distance_to(marked);
}

// The steps of a line of heights that go up (or, with `sign` -1, down). Index i stands for the side between the
// heights i and i + 1.
class StepsOneWay {
 public:
  StepsOneWay(const std::vector<float>& line, float sign) : rise_(line.size() - 1) {
    for (std::size_t i = 0; i < rise_.size(); ++i) {
      const float rise = sign * (line[i + 1] - line[i]);
      rise_[i] = rise > 0 ? rise : 0;  // also where a height is unknown
    }
  }

  // Height of the step around side i; 0 where the side itself does not rise.
  double height(int i) const {
    if (!(rise(i) > 0)) return 0;
    const double slope = std::min(rise(i - 2), rise(i + 2));  // what goes on behind the step is no part of it
    return rise(i - 1) + rise(i) + rise(i + 1) - 3 * slope;
  }

  // Whether the step around side i is concentrated there rather than on a side near by; of equal ones the first is.
  bool is_strongest(int i) const {
    for (int j = i - 2; j <= i + 2; ++j)
      if (weight(j) > weight(i) || (j < i && weight(j) == weight(i))) return false;
    return true;
  }

 private:
  double rise(int i) const { return i >= 0 && i < static_cast<int>(rise_.size()) ? rise_[i] : 0; }
  // Half weight beside the side: the two sides of a sharp step are weaker than itself.
  double weight(int i) const { return rise(i) > 0 ? rise(i) + 0.5 * (rise(i - 1) + rise(i + 1)) : 0; }

  std::vector<float> rise_;
};

// Sides of a line of heights that are edges, in order.
std::vector<int> steps_along(const std::vector<float>& line, double step_m) {
  if (line.size() < 2) return {};
  const StepsOneWay up(line, 1), down(line, -1);
  std::vector<int> sides;
  for (int i = 0; i + 1 < static_cast<int>(line.size()); ++i)
    for (const StepsOneWay* steps : {&up, &down})
      if (steps->height(i) > step_m && steps->is_strongest(i)) sides.push_back(i);
  return sides;
}

template <typename Keep>
std::vector<HeightEdge> only(const std::vector<HeightEdge>& edges, Keep keep) {
  std::vector<HeightEdge> kept;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(kept), keep);
  return kept;
}

std::int64_t count_within(const std::vector<HeightEdge>& edges, const Array2d<float>& squared_distance, double limit) {
  return std::count_if(edges.begin(), edges.end(), [&](const HeightEdge& edge) {
    return squared_distance(edge.x_half_cells(), edge.y_half_cells()) <= limit;
  });
}

}  // namespace

std::vector<HeightEdge> height_edges(const Array2d<float>& heights, double step_m) {
  std::vector<HeightEdge> edges;
  for (int row = 0; row < heights.height(); ++row) {
    const std::vector<float> line(heights.row(row), heights.row(row) + heights.width());
    for (const int column : steps_along(line, step_m)) edges.push_back({column, row, false});
  }
  for (int column = 0; column < heights.width(); ++column) {
    std::vector<float> line;
    for (int row = 0; row < heights.height(); ++row) line.push_back(heights(column, row));
    for (const int row : steps_along(line, step_m)) edges.push_back({column, row, true});
  }
  std::sort(edges.begin(), edges.end(), [](const HeightEdge& a, const HeightEdge& b) {
    return std::tuple(a.row, a.column, a.to_south) < std::tuple(b.row, b.column, b.to_south);
  });
  return edges;
}

double EdgeScore::precision() const { return share(measured_right, measured_count); }
double EdgeScore::recall() const { return share(true_found, true_count); }
double EdgeScore::f_score() const {
  if (true_count == 0 && measured_count == 0) return std::numeric_limits<double>::quiet_NaN();
  if (true_found == 0 || measured_right == 0) return 0;
  return 2 * precision() * recall() / (precision() + recall());
}

EdgeScores compare_edges(const HeightDifferences& cells, double step_m, double gsd_m,
                         const Array2d<std::uint8_t>* region) {
  const int width = cells.truth.width(), height = cells.truth.height();
  const auto truth_known = [&](const HeightEdge& e) {
    return !std::isnan(cells.truth(e.column, e.row)) && !std::isnan(cells.truth(e.other_column(), e.other_row()));
  };
  const auto in_region = [&](const HeightEdge& e) {
    return !region || (*region)(e.column, e.row) > 0 || (*region)(e.other_column(), e.other_row()) > 0;
  };
  const std::vector<HeightEdge> truth = height_edges(cells.truth, step_m);
  const std::vector<HeightEdge> measured = only(height_edges(cells.measured, step_m), truth_known);
  const std::vector<HeightEdge> truth_inside = only(truth, in_region), measured_inside = only(measured, in_region);

  EdgeScores scores;
  const double unit_m = std::max(gsd_m, cells.grid.cell_m);
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i].tolerance_m = kEdgeTolerances[i] * unit_m;
  // A tolerance that is met exactly must not fail by rounding.
  const auto limit = [&](std::size_t i) {
    const double half_cells = 2 * scores[i].tolerance_m / cells.grid.cell_m;
    return half_cells * half_cells * (1 + 1e-6);
  };
  // One distance field at a time: on large maps they are what takes memory (20 bytes per cell).
  const auto within = [&](const std::vector<HeightEdge>& edges, const std::vector<HeightEdge>& counterparts) {
    const Array2d<float> distance = squared_distance_to_edges(counterparts, width, height);
    std::array<std::int64_t, kEdgeTolerances.size()> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = count_within(edges, distance, limit(i));
    return counts;
  };
  const auto right = within(measured_inside, truth), found = within(truth_inside, measured);
  for (std::size_t i = 0; i < scores.size(); ++i)
    scores[i] = {scores[i].tolerance_m, static_cast<std::int64_t>(truth_inside.size()), found[i],
                 static_cast<std::int64_t>(measured_inside.size()), right[i]};
  return scores;
}

}  // namespace skysweep::report
