// SPDX-License-Identifier: Apache-2.0
#include "sweep/exposure.h"

#include <algorithm>
#include <cmath>

#include "sweep/linear_light.h"

namespace skysweep::sweep {
namespace {

constexpr int kFewestPlaces = 10;       // that two views must share to be compared
constexpr int kDark = 12, kFull = 245;  // bytes below or above tell nothing of the exposure: noise, clipping
constexpr double kLeastScatter = 0.01;  // of the differences at single places: grey levels are whole numbers
constexpr double kPlacesAlike = 16;     // neighbouring places err alike: that many count as one
constexpr double kPriorWeight = 1;      // draws the mean of all to 0, and views that share no place with others
constexpr double kSureDeviations = 4;   // standard deviations beyond which a difference is none by chance
constexpr int kNodeCells = 16;          // between the places where the mean exposure is found

std::array<std::uint8_t, 3> channels(Rgb8 c) { return {c.r, c.g, c.b}; }

// Differences of logarithms at the places that two views share, for every pair i < k and channel.
class PairSamples {
 public:
  PairSamples(const Array2d<CellCandidates>& cells, int views, int step) : views_(views), of_(3 * views * views) {
    std::array<float, 256> log_light{};
    for (int i = 1; i < 256; ++i) log_light[i] = std::log(linear_light(static_cast<std::uint8_t>(i)));
    for (int y = step / 2; y < cells.height(); y += step)
      for (int x = step / 2; x < cells.width(); x += step) add(cells(x, y), log_light);
  }

  std::vector<float>& between(int i, int k, int channel) { return of_[(channel * views_ + i) * views_ + k]; }

 private:
  void add(const CellCandidates& cell, const std::array<float, 256>& log_light) {
    for (const ColorCandidate* a = cell.begin(); a != cell.end(); ++a) {
      for (const ColorCandidate* b = a + 1; b != cell.end(); ++b) {
        const bool ascending = a->view < b->view;
        const auto first = channels((ascending ? a : b)->color), second = channels((ascending ? b : a)->color);
        for (int c = 0; c < 3; ++c) {
          if (std::min(first[c], second[c]) < kDark || std::max(first[c], second[c]) > kFull) continue;
          between(std::min(a->view, b->view), std::max(a->view, b->view), c)
              .push_back(log_light[first[c]] - log_light[second[c]]);
        }
      }
    }
  }

  int views_;
  std::vector<std::vector<float>> of_;
};

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Difference {
  double value = 0;   // median over the places
  double weight = 0;  // inverse variance
};

Difference robust_difference(std::vector<float>& values) {
  const float middle = median(values);
  for (float& value : values) value = std::abs(value - middle);
  const double scatter = std::max(kLeastScatter, 1.4826 * median(values));  // of a normal distribution
  const double variance = 1.5708 * scatter * scatter * kPlacesAlike / static_cast<double>(values.size());
  return {middle, 1 / variance};
}

// The lower triangle L (row-major n x n) of L L' = a, in place of the symmetric positive definite a.
void factorize(std::vector<double>& a, int n) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (int k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
    }
  }
}

// x of L L' x = b.
std::vector<double> solved(const std::vector<double>& l, std::vector<double> b) {
  const int n = static_cast<int>(b.size());
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= l[i * n + k] * b[k];
    b[i] /= l[i * n + i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) b[i] -= l[k * n + i] * b[k];
    b[i] /= l[i * n + i];
  }
  return b;
}

struct ChannelGains {
  std::vector<double> log_gain;
  bool differ = false;  // surely
};

// Whether the gains of two views differ by more than noise explains; `factor` of the normal equations.
bool surely_differ(const std::vector<double>& log_gain, const std::vector<double>& factor) {
  const int views = static_cast<int>(log_gain.size());
  for (int i = 0; i < views; ++i) {
    std::vector<double> unit(views, 0);
    for (int k = 0; k < i; ++k) {
      // The variance of g_i - g_k: what the prior says of the mean of views that are compared with each other cancels.
      unit[i] = 1, unit[k] = -1;
      const std::vector<double> column = solved(factor, unit);
      const double deviation = std::sqrt(std::max(0.0, column[i] - column[k]));
      if (std::abs(log_gain[i] - log_gain[k]) > kEqualExposure + kSureDeviations * deviation) return true;
      unit[k] = 0;
    }
  }
  return false;
}

// The least squares of the differences between all pairs of views.
ChannelGains gains_of_channel(PairSamples& samples, int views, int channel) {
  std::vector<double> normal(static_cast<std::size_t>(views) * views, 0), right(views, 0);
  for (int i = 0; i < views; ++i) normal[i * views + i] = kPriorWeight;
  for (int i = 0; i < views; ++i) {
    for (int k = i + 1; k < views; ++k) {
      std::vector<float>& between = samples.between(i, k, channel);
      if (between.size() < kFewestPlaces) continue;
      const Difference difference = robust_difference(between);
      normal[i * views + i] += difference.weight;
      normal[k * views + k] += difference.weight;
      normal[k * views + i] -= difference.weight;  // the lower half is all that is read
      right[i] += difference.weight * difference.value;
      right[k] -= difference.weight * difference.value;
    }
  }
  factorize(normal, views);
  const std::vector<double> log_gain = solved(normal, right);
  return {log_gain, surely_differ(log_gain, normal)};
}

// Mean height of the known cells around a node; nothing if there are none.
std::optional<double> mean_height_around(const Array2d<float>& height_m, int column, int row) {
  double sum = 0;
  int known = 0;
  for (int y = std::max(0, row - kNodeCells); y < std::min(height_m.height(), row + kNodeCells); ++y)
    for (int x = std::max(0, column - kNodeCells); x < std::min(height_m.width(), column + kNodeCells); ++x)
      if (const float z = height_m(x, y); !std::isnan(z)) sum += z, ++known;
  if (known == 0) return std::nullopt;
  return sum / known;
}

// 1 in the middle of the photograph, 0 at its border.
double centrality(const camera::Camera& camera, Vec2d pixel) {
  const double across = std::abs(2 * pixel.x / camera.model().width_px - 1);
  const double along = std::abs(2 * pixel.y / camera.model().height_px - 1);
  return std::max(0.0, 1 - std::max(across, along));
}

LogGain mean_gain_at(const SweepProblem& problem, Vec3d point, const std::vector<LogGain>& log_gains) {
  LogGain sum{};
  double weights = 0;
  for (std::size_t v = 0; v < problem.views.size(); ++v) {
    const camera::Camera& camera = problem.views[v].camera;
    const std::optional<Vec2d> pixel = camera.project(point);
    if (!pixel || !camera.shows(*pixel)) continue;
    const double central = centrality(camera, *pixel), weight = central * central;
    weights += weight;
    for (int c = 0; c < 3; ++c) sum[c] += weight * log_gains[v][c];
  }
  if (weights > 0)
    for (double& value : sum) value /= weights;
  return sum;
}

// The mean exposure on a grid of nodes kNodeCells apart, the first in the region's first cell; linear between them.
class MeanExposure {
 public:
  MeanExposure(const SweepProblem& problem, const Array2d<float>& height_m, const CoreWithMargin& region,
               const std::vector<LogGain>& log_gains)
      : nodes_(region.width / kNodeCells + 2, region.height / kNodeCells + 2) {
    double z = 0;  // where nothing is known: that of the node before
    for (int y = 0; y < nodes_.height(); ++y) {
      for (int x = 0; x < nodes_.width(); ++x) {
        const int column = region.first_column + x * kNodeCells, row = region.first_row + y * kNodeCells;
        z = mean_height_around(height_m, column, row).value_or(z);
        const Vec2d cell = problem.grid.cell_center(column, row);
        nodes_(x, y) = mean_gain_at(problem, {cell.x, cell.y, z}, log_gains);
      }
    }
  }

  // Factors on linear light; `column`, `row` in the region.
  std::array<float, 3> at(int column, int row) const {
    const int x = column / kNodeCells, y = row / kNodeCells;
    const double u = static_cast<double>(column % kNodeCells) / kNodeCells,
                 v = static_cast<double>(row % kNodeCells) / kNodeCells;
    std::array<float, 3> out;
    for (int c = 0; c < 3; ++c) {
      const double log_gain =
          mix(mix(nodes_(x, y)[c], nodes_(x + 1, y)[c], u), mix(nodes_(x, y + 1)[c], nodes_(x + 1, y + 1)[c], u), v);
      out[c] = static_cast<float>(std::exp(log_gain));
    }
    return out;
  }

 private:
  Array2d<LogGain> nodes_;
};

}  // namespace

std::vector<LogGain> estimate_exposures(const Array2d<CellCandidates>& cells, int views, int step) {
  PairSamples samples(cells, views, step);
  std::vector<LogGain> gains(views);
  bool differ = false;
  for (int c = 0; c < 3; ++c) {
    const ChannelGains channel = gains_of_channel(samples, views, c);
    for (int v = 0; v < views; ++v) gains[v][c] = channel.log_gain[v];
    differ = differ || channel.differ;
  }
  if (!differ) gains.clear();
  return gains;
}

void equalize_exposures(const SweepProblem& problem, const Array2d<float>& height_m, const CoreWithMargin& region,
                        const std::vector<LogGain>& log_gains, Executor& executor, Array2d<CellCandidates>& cells) {
  const MeanExposure mean(problem, height_m, region, log_gains);
  std::vector<std::array<float, 3>> inverse(log_gains.size());
  for (std::size_t v = 0; v < log_gains.size(); ++v)
    for (int c = 0; c < 3; ++c) inverse[v][c] = static_cast<float>(std::exp(-log_gains[v][c]));
  executor.parallel_for(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      CellCandidates& cell = cells(x, y);
      if (cell.count == 0) continue;
      const std::array<float, 3> wanted = mean.at(x, y);
      for (int i = 0; i < cell.count; ++i) {
        const std::array<float, 3>& own = inverse[cell.of[i].view];
        Rgb8& color = cell.of[i].color;
        color = {encoded_light(linear_light(color.r) * own[0] * wanted[0]),
                 encoded_light(linear_light(color.g) * own[1] * wanted[1]),
                 encoded_light(linear_light(color.b) * own[2] * wanted[2])};
      }
    }
  });
}

}  // namespace skysweep::sweep
