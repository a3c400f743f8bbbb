// SPDX-License-Identifier: Apache-2.0
#include "sweep/height_sigma.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/sigma_parameters.h"

namespace skysweep::sweep {
namespace {

// Logarithms are taken of values above these: a height that is exactly the mean of its neighbours is not exact.
constexpr double kSmallestStep = 0.05, kSmallestOffset = 0.01;  // of the height that is worth a pixel
constexpr double kSmallestExcess = 0.2, kTypicalCost = 3;       // grey levels
constexpr double kSmallestDifference = 0.3, kSureMargin = 4;    // of the usual difference
// Beyond this excess a cell is as sure as can be; what follows is centred and scaled for the fit.
constexpr double kSureExcess = 18, kMiddleExcess = 12, kExcessScale = 10;

// The signs of one cell, heights in units of the height that is worth a pixel.
struct Signs {
  double step_5, step_17, offset, excess_3, excess_9, undecided, bend_9, cost_9, cost_17;
  double edge_margin, edge_difference;  // NaN: had no choice
};

double log_sigma_of_doubtless(const Signs& s) {
  const SigmaOfDoubtless& p = kSigmaOfDoubtless;
  return p.level + p.step * std::log(kSmallestStep + s.step_5) + p.offset * std::log(kSmallestOffset + s.offset) +
         p.excess * (std::min(s.excess_9, kSureExcess) - kMiddleExcess) / kExcessScale + p.bend * std::log(s.bend_9) +
         p.cost * std::log(s.cost_9 / kTypicalCost);
}

bool is_doubtful(const Signs& s) {
  const Doubt& p = kDoubt;
  return std::log(kSmallestExcess + s.excess_3) <
         p.level + p.cost * std::log(s.cost_17 / kTypicalCost) + p.undecided * s.undecided;
}

double log_sigma_of_doubtful(const Signs& s) {
  const SigmaOfDoubtful& p = kSigmaOfDoubtful;
  return p.level + p.cost * std::log(s.cost_17 / kTypicalCost) + p.undecided * s.undecided +
         std::log(std::max(1.0, s.step_17));
}

// What the colours say of a cell at a step is worth more than what the costs of windows across it say.
double log_sigma_at_edge(const Signs& s) {
  const double difference = std::log(std::max(kSmallestDifference, s.edge_difference));
  const SigmaOfEdges& p = kSigmaOfEdges;
  const double sure = p.level + p.difference * difference + p.margin * std::clamp(s.edge_margin, 0.0, kSureMargin);
  const EdgeDoubt& d = kEdgeDoubt;
  const bool may_be_either = s.edge_margin < d.level + d.difference * difference + d.undecided * s.undecided &&
                             std::log(kSmallestExcess + s.excess_3) < d.excess;
  return may_be_either ? std::max(sure, kEdgeStep + std::log(std::max(1.0, s.step_17))) : sure;
}

// In units of the height that is worth a pixel.
double sigma_of(const Signs& s) {
  if (!std::isnan(s.edge_margin)) return std::max(kBestPixels, std::exp(log_sigma_at_edge(s)));
  const double sure = log_sigma_of_doubtless(s);
  return std::max(kBestPixels, std::exp(is_doubtful(s) ? std::max(sure, log_sigma_of_doubtful(s)) : sure));
}

}  // namespace

Array2d<float> height_sigma(const Array2d<float>& height_m, const SigmaSigns& signs, double dz_m) {
  Array2d<float> sigma_m(height_m.width(), height_m.height(), std::numeric_limits<float>::quiet_NaN());
  const auto of_edge = [](const Array2d<float>& sign, std::size_t i) {
    return sign.empty() ? std::numeric_limits<double>::quiet_NaN() : sign.data()[i];
  };
  for (std::size_t i = 0; i < sigma_m.size(); ++i) {
    if (std::isnan(height_m.data()[i])) continue;
    const double known = signs.height_per_pixel_m.data()[i];
    const double unit_m =
        std::isnan(known) ? dz_m : known;  // a cell that views show, in a block whose centre they miss
    // Costs of nothing but equal pixels are 0, and so may bends be.
    constexpr double kSmallestCost = 1e-3;
    const Signs cell{signs.step_5_m.data()[i] / unit_m,
                     signs.step_17_m.data()[i] / unit_m,
                     signs.offset_m.data()[i] / unit_m,
                     signs.excess_3.data()[i],
                     signs.excess_9.data()[i],
                     signs.undecided.data()[i],
                     std::max<double>(kSmallestCost, signs.bend_9.data()[i]) * unit_m / dz_m,
                     std::max<double>(kSmallestCost, signs.cost_9.data()[i]),
                     std::max<double>(kSmallestCost, signs.cost_17.data()[i]),
                     of_edge(signs.edges.margin, i),
                     of_edge(signs.edges.difference, i)};
    sigma_m.data()[i] = static_cast<float>(unit_m * sigma_of(cell));
  }
  return sigma_m;
}

void set_sigma(const SweepProblem& problem, const MatchResult& matches, Heights& heights) {
  heights.sigma_m = height_sigma(heights.height_m, sigma_signs(problem, matches, heights.height_m), problem.dz_m);
}

}  // namespace skysweep::sweep
