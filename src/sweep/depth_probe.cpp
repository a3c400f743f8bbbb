// SPDX-License-Identifier: Apache-2.0
#include "sweep/depth_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skysweep::sweep {
namespace {

constexpr int kLongSidePx = 96;  // of the low-resolution photograph
constexpr int kRadius = 2;       // of the correlation window
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

struct LowResolution {
  int level = 0;
  int width = 0, height = 0;
};

LowResolution low_resolution(const ImagePyramid& image) {
  int level = 0;
  while (level + 1 < image.levels() &&
         std::max(image.luminance(level).width, image.luminance(level).height) > kLongSidePx)
    ++level;
  return {level, image.luminance(level).width, image.luminance(level).height};
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

// The neighbour's luminance warped onto the reference's pixels by the plane `depth` below its CoP; NaN outside.
Array2d<float> warp(const View& reference, const View& neighbour, const LowResolution& size, double depth) {
  Array2d<float> out(size.width, size.height, std::nanf(""));
  const double z = reference.camera.pose().center.z - depth;
  const double pixel_size = std::ldexp(1.0, size.level);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto point = reference.camera.at_height({(x + 0.5) * pixel_size, (y + 0.5) * pixel_size}, z);
      if (!point) continue;
      const auto pixel = neighbour.camera.project(*point);
      if (pixel && neighbour.camera.shows(*pixel))
        out(x, y) = static_cast<float>(
            neighbour.image->sample_luminance(*pixel, std::min(size.level, neighbour.image->levels() - 1)));
    }
  }
  return out;
}

// Correlation of the windows around (x, y); nothing without texture or when the window leaves either image.
std::optional<double> correlation(const Array2d<float>& a, const Array2d<float>& b, int x, int y) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  constexpr double n = (2 * kRadius + 1) * (2 * kRadius + 1);
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const double va = a(x + dx, y + dy), vb = b(x + dx, y + dy);
      sa += va, sb += vb, saa += va * va, sbb += vb * vb, sab += va * vb;
    }
  }
  const double variance_a = saa - sa * sa / n, variance_b = sbb - sb * sb / n;
  if (!(variance_a > n && variance_b > n)) return std::nullopt;  // a standard deviation of one grey level
  return (sab - sa * sb / n) / std::sqrt(variance_a * variance_b);
}

Array2d<float> low_resolution_luminance(const View& view, const LowResolution& size) {
  Array2d<float> out(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      out(x, y) = static_cast<float>(view.image->luminance(size.level).at(x, y) / kLuminanceScale);
  return out;
}

constexpr int kNoPlane = -1000;

// The plane with the best score of each pixel, where it is good and no plane apart from it comes near.
Array2d<int> distinct_planes(const std::vector<Array2d<float>>& scores) {
  Array2d<int> planes(scores[0].width(), scores[0].height(), kNoPlane);
  const int count = static_cast<int>(scores.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    int best = 0;
    for (int d = 1; d < count; ++d)
      if (scores[d].data()[i] > scores[best].data()[i]) best = d;
    const float peak = scores[best].data()[i];
    bool distinct = peak >= kGoodCorrelation;
    for (int d = 0; d < count && distinct; ++d)
      distinct = std::abs(d - best) <= kPeakWidth || scores[d].data()[i] <= peak - kDistinct;
    if (distinct) planes.data()[i] = best;
  }
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
  const LowResolution size = low_resolution(*reference.image);
  const std::vector<double> depths = depths_to_search(reference, neighbours, size.level);
  if (depths.empty()) return std::nullopt;
  const Array2d<float> own = low_resolution_luminance(reference, size);

  // score[plane] = mean correlation over the neighbours that show the pixel; -2 = none.
  std::vector<Array2d<float>> scores(depths.size(), Array2d<float>(size.width, size.height, -2.0f));
  for (std::size_t d = 0; d < depths.size(); ++d) {
    Array2d<float> sum(size.width, size.height, 0), count(size.width, size.height, 0);
    for (const View& neighbour : neighbours) {
      const Array2d<float> warped = warp(reference, neighbour, size, depths[d]);
      for (int y = kRadius; y < size.height - kRadius; ++y) {
        for (int x = kRadius; x < size.width - kRadius; ++x) {
          const auto value = correlation(own, warped, x, y);
          if (!value) continue;
          sum(x, y) += static_cast<float>(*value);
          count(x, y) += 1;
        }
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (count.data()[i] > 0) scores[d].data()[i] = sum.data()[i] / count.data()[i];
  }

  const Array2d<int> planes = distinct_planes(scores);
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
