// SPDX-License-Identifier: Apache-2.0
#include "report/height_edges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

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
  for (int row = 0; row < heights.height(); ++row)
    for (int column = 0; column < heights.width(); ++column) {
      const float here = heights(column, row);
      // Comparisons with NaN are false.
      if (column + 1 < heights.width() && std::abs(heights(column + 1, row) - here) > step_m)
        edges.push_back({column, row, false});
      if (row + 1 < heights.height() && std::abs(heights(column, row + 1) - here) > step_m)
        edges.push_back({column, row, true});
    }
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
  // A tolerance that is met exactly must not fail by rounding.
  const auto limit = [&](std::size_t i) {
    const double half_cells = 2 * kEdgeTolerancesGsd[i] * gsd_m / cells.grid.cell_m;
    return half_cells * half_cells * (1 + 1e-6);
  };
  // One distance field at a time: on large maps they are what takes memory (20 bytes per cell).
  const auto within = [&](const std::vector<HeightEdge>& edges, const std::vector<HeightEdge>& counterparts) {
    const Array2d<float> distance = squared_distance_to_edges(counterparts, width, height);
    std::array<std::int64_t, kEdgeTolerancesGsd.size()> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = count_within(edges, distance, limit(i));
    return counts;
  };
  const auto right = within(measured_inside, truth), found = within(truth_inside, measured);
  for (std::size_t i = 0; i < scores.size(); ++i)
    scores[i] = {static_cast<std::int64_t>(truth_inside.size()), found[i],
                 static_cast<std::int64_t>(measured_inside.size()), right[i]};
  return scores;
}

}  // namespace skysweep::report
