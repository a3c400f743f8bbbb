// SPDX-License-Identifier: Apache-2.0
#include "report/step_displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "report/height_edges.h"
#include "report/quantile.h"

namespace skysweep::report {
namespace {

constexpr double kReach = 6;            // of the profile to both sides, in cells or GSD, whichever is larger
constexpr double kSpacingCells = 0.25;  // of the samples along the profile
constexpr int kStripCells = 2;          // the profile is a strip this wide to both sides
constexpr int kNormalCells = 3;         // radius of the disc that tells the direction of the normal
constexpr double kStraight = 0.9;       // least moment of that disc, of the moment of a straight edge
constexpr double kTrueLevel = 0.9;  // least mean of the higher end of a clean true profile (lower end: the rest to 1)
constexpr double kMeasuredLevel = 0.75;

// Bilinear height between cell centres; positions in cells from the centre of the north-west cell. NaN beside holes.
double height_at(const Array2d<float>& heights, Vec2d p) {
  const double left = std::floor(p.x), top = std::floor(p.y);
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  if (!heights.contains(column, row) || !heights.contains(column + 1, row + 1))
    return std::numeric_limits<double>::quiet_NaN();
  const double u = p.x - left, v = p.y - top;
  return (1 - v) * ((1 - u) * heights(column, row) + u * heights(column + 1, row)) +
         v * ((1 - u) * heights(column, row + 1) + u * heights(column + 1, row + 1));
}

// Unit normal of a true step, pointing to the lower side; nothing where the step is not straight. The heights around
// are clamped between those of the edge's two cells, so that other objects near by do not pull.
std::optional<Vec2d> normal_of(const Array2d<float>& truth, const HeightEdge& edge) {
  const double a = truth(edge.column, edge.row), b = truth(edge.other_column(), edge.other_row());
  const double low = std::min(a, b), high = std::max(a, b);
  const Vec2d middle{edge.x_half_cells() / 2.0, edge.y_half_cells() / 2.0};
  Vec2d moment{};
  std::vector<Vec2d> disc;
  for (int row = edge.row - kNormalCells; row <= edge.row + kNormalCells + 1; ++row)
    for (int column = edge.column - kNormalCells; column <= edge.column + kNormalCells + 1; ++column) {
      const Vec2d q = Vec2d{static_cast<double>(column), static_cast<double>(row)} - middle;
      if (norm(q) > kNormalCells) continue;
      if (!truth.contains(column, row) || std::isnan(truth(column, row))) return std::nullopt;
      const double z = (std::clamp<double>(truth(column, row), low, high) - low) / (high - low) - 0.5;
      moment = moment - z * q;
      disc.push_back(q);
    }
  const double length = norm(moment);
  if (!(length > 0)) return std::nullopt;
  const Vec2d normal = (1 / length) * moment;
  double straight = 0;
  for (const Vec2d q : disc) straight += 0.5 * std::abs(dot(q, normal));
  return length >= kStraight * straight ? std::optional(normal) : std::nullopt;
}

// Heights in a strip across a step, from the higher side to the lower one.
struct Profile {
  double high = 0, low = 0;        // heights of the outer halves
  std::vector<double> high_share;  // mean over the strip, of how far the height lies from low (0) to high (1)
};

class ProfileReader {
 public:
  explicit ProfileReader(double reach_cells) : half_count_(static_cast<int>(std::ceil(reach_cells / kSpacingCells))) {}

  // Nothing if any height is unknown.
  std::optional<Profile> read(const Array2d<float>& heights, Vec2d middle, Vec2d normal) const {
    const Vec2d tangent{-normal.y, normal.x};
    std::vector<double> samples;
    std::vector<float> high_side, low_side;
    for (int i = -half_count_; i <= half_count_; ++i)
      for (int t = -kStripCells; t <= kStripCells; ++t) {
        const double z = height_at(heights, middle + (i * kSpacingCells) * normal + static_cast<double>(t) * tangent);
        if (std::isnan(z)) return std::nullopt;
        samples.push_back(z);
        if (2 * i <= -half_count_) high_side.push_back(static_cast<float>(z));
        if (2 * i >= half_count_) low_side.push_back(static_cast<float>(z));
      }
    Profile out{quantile(high_side, 0.5), quantile(low_side, 0.5), {}};
    constexpr int kLines = 2 * kStripCells + 1;
    for (std::size_t first = 0; first < samples.size(); first += kLines) {
      double sum = 0;
      for (std::size_t line = 0; line < kLines; ++line)
        sum += std::clamp((samples[first + line] - out.low) / (out.high - out.low), 0.0, 1.0);
      out.high_share.push_back(sum / kLines);
    }
    return out;
  }

  // One step from `level` of the height and more down to the rest of it and less.
  bool is_clean(const Profile& profile, double level) const {
    const auto begin = profile.high_share.begin(), end = profile.high_share.end();
    const int outer = half_count_ / 2 + 1;
    const double high = std::accumulate(begin, begin + outer, 0.0) / outer;
    const double low = std::accumulate(end - outer, end, 0.0) / outer;
    return high >= level && low <= 1 - level;
  }

  // Where the step stands from the middle of the profile, in cells: the length on which the ground is high
  // (trapezoids).
  double position(const Profile& profile) const {
    const auto& share = profile.high_share;
    const double sum = std::accumulate(share.begin(), share.end(), 0.0) - 0.5 * (share.front() + share.back());
    return kSpacingCells * (sum - half_count_);
  }

 private:
  int half_count_;
};

}  // namespace

StepDisplacement step_displacement(const HeightDifferences& cells, double step_m, double gsd_m,
                                   const Array2d<std::uint8_t>* region) {
  const double cell_m = cells.grid.cell_m;
  StepDisplacement out;
  out.reach_m = kReach * std::max(cell_m, gsd_m);
  const ProfileReader reader(out.reach_m / cell_m);
  std::vector<float> displacements;
  for (const HeightEdge& edge : height_edges(cells.truth, step_m)) {
    if (region && !(*region)(edge.column, edge.row) && !(*region)(edge.other_column(), edge.other_row())) continue;
    const std::optional<Vec2d> normal = normal_of(cells.truth, edge);
    if (!normal) continue;
    const Vec2d middle{edge.x_half_cells() / 2.0, edge.y_half_cells() / 2.0};
    const std::optional<Profile> truth = reader.read(cells.truth, middle, *normal);
    if (!truth || !(truth->high - truth->low > step_m) || !reader.is_clean(*truth, kTrueLevel)) continue;
    ++out.steps;
    const std::optional<Profile> measured = reader.read(cells.measured, middle, *normal);
    if (!measured || !(measured->high - measured->low > 0.5 * (truth->high - truth->low)) ||
        !reader.is_clean(*measured, kMeasuredLevel))
      continue;
    ++out.found;
    displacements.push_back(static_cast<float>(cell_m * (reader.position(*measured) - reader.position(*truth))));
  }
  const auto count = static_cast<double>(displacements.size());
  out.mean_m = std::accumulate(displacements.begin(), displacements.end(), 0.0) / count;  // NaN if there are none
  out.median_m = quantile(displacements, 0.5);
  out.p5_m = quantile(displacements, 0.05);
  out.p95_m = quantile(displacements, 0.95);
  for (float& d : displacements) d = std::abs(d);
  out.median_absolute_m = quantile(displacements, 0.5);
  return out;
}

}  // namespace skysweep::report
