// SPDX-License-Identifier: Apache-2.0
#include "sweep/depth_probe.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "sweep/plane_warp.h"
#include "sweep/window_correlation.h"

namespace skysweep::sweep {
namespace {

constexpr int kLongSidePx = 96;  // of the low-resolution photograph
constexpr int kMaxPlanes = 512;
constexpr double kStepPx = 0.5;  // parallax from one plane to the next, low-resolution pixels
constexpr double kNearestBaselines = 0.5, kFarthestBaselines = 60;  // depths searched, in baselines
constexpr double kGoodCorrelation = 0.6;
constexpr double kDistinct = 0.1;       // the best plane must beat all that are not next to it by this much
constexpr double kFewestPixels = 0.08;  // share of the photograph that must find its depth
constexpr int kAgreeing = 4;            // of the eight neighbours, so many must find nearly the same plane
constexpr int kPeakWidth = 6;           // planes that count as the same peak
constexpr int kAgreement = 3;           // planes by which neighbours may differ
// False matches scatter over all parallaxes, a surface does not: so much of what is trusted must lie near the median.
constexpr double kNearMedian = 0.3, kFewestNearMedian = 0.6;

int low_resolution(const ImagePyramid& image) {
  int level = 0;
  while (level + 1 < image.levels() &&
         std::max(image.luminance(level).width, image.luminance(level).height) > kLongSidePx)
    ++level;
  return level;
}

double horizontal_distance(Vec3d a, Vec3d b) { return norm(Vec2d{a.x - b.x, a.y - b.y}); }

// Depths below the reference, equally spaced in parallax.
std::vector<double> depths_to_search(const View& reference, const std::vector<View>& neighbours, int level) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const View& v : neighbours) {
    const double baseline = horizontal_distance(v.camera.pose().center, reference.camera.pose().center);
    if (baseline <= 0) continue;
    shortest = std::min(shortest, baseline);
    longest = std::max(longest, baseline);
  }
  if (longest == 0) return {};
  const double nearest = kNearestBaselines * shortest, farthest = kFarthestBaselines * longest;
  const double focal = std::ldexp(reference.camera.model().focal_px(), -level);
  // Limited before it becomes a whole number: with a neighbour a micrometre away the parallax exceeds any.
  const double steps = focal * longest * (1 / nearest - 1 / farthest) / kStepPx;
  const int count = static_cast<int>(std::min<double>(steps, kMaxPlanes - 2)) + 2;
  std::vector<double> depths(count);
  for (int i = 0; i < count; ++i) depths[i] = 1 / (1 / farthest + (1 / nearest - 1 / farthest) * i / (count - 1));
  return depths;
}

Array2d<float> grey_levels(const LuminanceLevel& luminance) {
  Array2d<float> out(luminance.width, luminance.height);
  for (int y = 0; y < luminance.height; ++y)
    for (int x = 0; x < luminance.width; ++x) out(x, y) = static_cast<float>(luminance.at(x, y) / kLuminanceScale);
  return out;
}

constexpr float kNoScore = -2;

// Of each plane and pixel the mean correlation over the neighbours that show it.
std::vector<Array2d<float>> correlations(const View& reference, const std::vector<View>& neighbours, int level,
                                         const std::vector<double>& depths) {
  const PixelRays rays(reference, level);
  std::vector<PlaneWarp> warps;
  for (const View& neighbour : neighbours) warps.emplace_back(rays, neighbour);
  WindowCorrelation correlation(grey_levels(reference.image->luminance(level)));

  std::vector<Array2d<float>> scores;
  Array2d<float> warped(rays.width, rays.height);
  for (const double depth : depths) {
    Array2d<float> sum(rays.width, rays.height, 0), count(rays.width, rays.height, 0);
    for (PlaneWarp& warp : warps) {
      warp.warp(depth, warped);
      correlation.add(warped, sum, count);
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum.data()[i] = count.data()[i] > 0 ? sum.data()[i] / count.data()[i] : kNoScore;
    scores.push_back(std::move(sum));
  }
  return scores;
}

constexpr int kNoPlane = -1000;

// The plane with the best score of each pixel, where it is good and no plane apart from it comes near.
Array2d<int> distinct_planes(const std::vector<Array2d<float>>& scores) {
  Array2d<int> planes(scores[0].width(), scores[0].height(), 0);
  Array2d<float> peaks = scores[0];
  // Plane after plane, as the scores lie in memory.
  for (int d = 1; d < static_cast<int>(scores.size()); ++d) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const bool better = scores[d].data()[i] > peaks.data()[i];
      peaks.data()[i] = better ? scores[d].data()[i] : peaks.data()[i];
      planes.data()[i] = better ? d : planes.data()[i];
    }
  }
  Array2d<std::uint8_t> distinct(planes.width(), planes.height());
  for (std::size_t i = 0; i < planes.size(); ++i) distinct.data()[i] = peaks.data()[i] >= kGoodCorrelation;
  for (int d = 0; d < static_cast<int>(scores.size()); ++d)
    for (std::size_t i = 0; i < planes.size(); ++i)
      distinct.data()[i] &=
          (std::abs(d - planes.data()[i]) <= kPeakWidth) | (scores[d].data()[i] <= peaks.data()[i] - kDistinct);
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (distinct.data()[i] == 0) planes.data()[i] = kNoPlane;
  return planes;
}

bool confirmed(const Array2d<int>& planes, int x, int y) {
  if (planes(x, y) == kNoPlane) return false;
  int agreeing = -1;  // the pixel itself
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      agreeing += planes.contains(x + dx, y + dy) && std::abs(planes(x + dx, y + dy) - planes(x, y)) <= kAgreement;
  return agreeing >= kAgreeing;
}

}  // namespace

std::optional<DepthProbe> probe_depth(const View& reference, const std::vector<View>& neighbours) {
  const int level = low_resolution(*reference.image);
  const std::vector<double> depths = depths_to_search(reference, neighbours, level);
  if (depths.empty()) return std::nullopt;
  const Array2d<int> planes = distinct_planes(correlations(reference, neighbours, level, depths));
  std::vector<double> trusted;
  for (int y = 0; y < planes.height(); ++y)
    for (int x = 0; x < planes.width(); ++x)
      if (confirmed(planes, x, y)) trusted.push_back(depths[planes(x, y)]);
  if (static_cast<double>(trusted.size()) < kFewestPixels * static_cast<double>(planes.size())) return std::nullopt;
  std::sort(trusted.begin(), trusted.end());
  const double middle = trusted[trusted.size() / 2];
  const auto near = std::count_if(trusted.begin(), trusted.end(), [&](double depth) {
    return std::abs(middle / depth - 1) <= kNearMedian;  // parallax is proportional to 1 / depth
  });
  if (static_cast<double>(near) < kFewestNearMedian * static_cast<double>(trusted.size())) return std::nullopt;
  const auto percentile = [&](double p) { return trusted[static_cast<std::size_t>(p * (trusted.size() - 1))]; };
  return DepthProbe{percentile(0.5), percentile(0.02), percentile(0.98), static_cast<int>(trusted.size())};
}

}  // namespace skysweep::sweep
