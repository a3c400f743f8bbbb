// SPDX-License-Identifier: Apache-2.0
#include "sweep/view_choice.h"

#include <algorithm>
#include <cstdlib>

namespace skysweep::sweep {
namespace {

// Costs are whole numbers, kUnit a grey level.
constexpr int kUnit = 16;
constexpr int kTolerated = 6 * kUnit;       // deviation that noise and interpolation make
constexpr int kSlopeCost = 16 * kUnit;      // of a line of sight at 45 degrees
constexpr int kUnknownDifference = 3 * 24;  // of two views one of which does not see the cell, sum of channels
constexpr int kRounds = kChoiceReach / 4;   // each of which passes a change on by up to four cells
constexpr std::array<std::array<int, 2>, 8> kNeighbors{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

int difference(Rgb8 a, Rgb8 b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

int difference(const ColorCandidate* a, const ColorCandidate* b) {
  return a && b ? difference(a->color, b->color) : kUnknownDifference;
}

using Costs = std::array<std::int32_t, kMostCandidates>;

class Choice {
 public:
  Choice(const Array2d<CellCandidates>& cells, double seam_cost)
      : cells_(cells), seam_cost_(static_cast<int>(seam_cost * kUnit + 0.5)) {}

  Costs own_costs(const CellCandidates& cell) const {
    const std::array<std::uint16_t, kMostCandidates> deviation = deviations(cell);
    Costs costs{};
    for (int i = 0; i < cell.count; ++i)
      costs[i] = std::max(0, deviation[i] - kTolerated) + kSlopeCost * cell.of[i].slope / kSlopeScale;
    return costs;
  }

  static std::int8_t cheapest(const Costs& costs, int count) {
    return static_cast<std::int8_t>(std::min_element(costs.begin(), costs.begin() + count) - costs.begin());
  }

  // The cell's best choice given those of its neighbours; its present one where all of them agree with it.
  std::int8_t given_neighbors(int x, int y, const Array2d<std::int8_t>& chosen) const {
    const CellCandidates& cell = cells_(x, y);
    const std::int8_t own = chosen(x, y);
    if (cell.count < 2) return own;
    std::array<const CellCandidates*, 8> other;
    std::array<const ColorCandidate*, 8> others_choice;
    int neighbors = 0;
    bool agree = true;
    for (const auto& [dx, dy] : kNeighbors) {
      if (!cells_.contains(x + dx, y + dy) || chosen(x + dx, y + dy) < 0) continue;
      other[neighbors] = &cells_(x + dx, y + dy);
      others_choice[neighbors] = &other[neighbors]->of[chosen(x + dx, y + dy)];
      agree = agree && others_choice[neighbors]->view == cell.of[own].view;
      ++neighbors;
    }
    if (agree) return own;
    Costs costs = own_costs(cell);
    for (int n = 0; n < neighbors; ++n) {
      const ColorCandidate* theirs = others_choice[n];
      const ColorCandidate* theirs_here = cell.find(theirs->view);
      for (int i = 0; i < cell.count; ++i) {
        if (cell.of[i].view == theirs->view) continue;
        const int apart = difference(&cell.of[i], theirs_here) + difference(other[n]->find(cell.of[i].view), theirs);
        costs[i] += seam_cost_ + seam_cost_ * apart / 12;
      }
    }
    return cheapest(costs, cell.count);
  }

 private:
  const Array2d<CellCandidates>& cells_;
  int seam_cost_;
};

}  // namespace

std::array<std::uint16_t, kMostCandidates> deviations(const CellCandidates& cell) {
  std::array<std::uint16_t, kMostCandidates> out{};
  if (cell.count < 3) return out;
  const int middle = (cell.count - 1) / 2;
  std::array<int, kMostCandidates> sums{};
  for (const auto channel : {&Rgb8::r, &Rgb8::g, &Rgb8::b}) {
    std::array<std::uint8_t, kMostCandidates> values;
    for (int i = 0; i < cell.count; ++i) values[i] = cell.of[i].color.*channel;
    std::nth_element(values.begin(), values.begin() + middle, values.begin() + cell.count);
    for (int i = 0; i < cell.count; ++i) sums[i] += std::abs(cell.of[i].color.*channel - values[middle]);
  }
  for (int i = 0; i < cell.count; ++i) out[i] = static_cast<std::uint16_t>(sums[i] * kUnit / 3);
  return out;
}

Array2d<std::int8_t> choose_views(const Array2d<CellCandidates>& cells, double seam_cost, Executor& executor) {
  const Choice choice(cells, seam_cost);
  Array2d<std::int8_t> chosen(cells.width(), cells.height(), -1);
  executor.parallel_for(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x)
      if (cells(x, y).count > 0) chosen(x, y) = Choice::cheapest(choice.own_costs(cells(x, y)), cells(x, y).count);
  });
  if (seam_cost == 0) return chosen;
  for (int step = 0; step < 4 * kRounds; ++step) {
    const int odd_column = step % 2, odd_row = step / 2 % 2;
    executor.parallel_for((cells.height() - odd_row + 1) / 2, [&](int half) {
      const int y = 2 * half + odd_row;
      for (int x = odd_column; x < cells.width(); x += 2)
        if (chosen(x, y) >= 0) chosen(x, y) = choice.given_neighbors(x, y, chosen);
    });
  }
  return chosen;
}

}  // namespace skysweep::sweep
