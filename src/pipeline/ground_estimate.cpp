// SPDX-License-Identifier: Apache-2.0
#include "pipeline/ground_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "sweep/depth_probe.h"

namespace skysweep::pipeline {
namespace {

using index::ImageRecord;

constexpr int kProbes = 12;          // photographs probed
constexpr int kProbeNeighbours = 4;  // each against so many
// Photographs nearer than this share of the typical distance between neighbours show no parallax.
constexpr double kSamePlace = 0.2;
// Surfaces are looked for up to this share of the nearest depth that a probe found, and never nearer than that share of
// the typical depth.
constexpr double kNearestOfNearest = 0.5, kNearestOfMedian = 0.1;
// Of the probes' farthest depths this quantile counts: single probes see ground that is not there.
constexpr double kFarthestQuantile = 0.75;
// Photographs serve what they show down to a little below the typical ground, or the lowest ground seen.
constexpr double kReachOfMedian = 1.15, kReachOfFarthest = 1.1;
// Views whose rays meet at more than this baseline-to-height ratio hardly ever serve the same place.
constexpr double kLargestBaselineRatio = 0.8;
constexpr double kSmallestBaselineRatio = 0.02;

std::vector<const ImageRecord*> used_records(const std::vector<ImageRecord>& records) {
  std::vector<const ImageRecord*> used;
  for (const ImageRecord& record : records)
    if (record.status == index::ImageStatus::used) used.push_back(&record);
  return used;
}

// Snapped, so that it is the same wherever the scene lies.
double distance_on_ground(const ImageRecord& a, const ImageRecord& b) {
  const Vec3d apart = camera::snap_position(a.pose.center - b.pose.center);
  return norm(Vec2d{apart.x, apart.y});
}

// The others by distance, nearest first; equal distances by name, so that the order of arrival does not matter.
std::vector<const ImageRecord*> others_by_distance(const ImageRecord& from,
                                                   const std::vector<const ImageRecord*>& all) {
  std::vector<const ImageRecord*> others;
  for (const ImageRecord* record : all)
    if (record != &from) others.push_back(record);
  std::sort(others.begin(), others.end(), [&](const ImageRecord* a, const ImageRecord* b) {
    const double da = distance_on_ground(from, *a), db = distance_on_ground(from, *b);
    return da != db ? da < db : a->name < b->name;
  });
  return others;
}

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

double typical_neighbour_distance(const std::vector<const ImageRecord*>& used) {
  std::vector<double> distances;
  for (const ImageRecord* record : used) {
    // The nearest that is not at the very same place.
    for (const ImageRecord* other : others_by_distance(*record, used)) {
      const double distance = distance_on_ground(*record, *other);
      if (distance <= 0) continue;
      distances.push_back(distance);
      break;
    }
  }
  return distances.empty() ? 0 : median(distances);
}

// Evenly spread over the names, first and last included.
std::vector<const ImageRecord*> probed_records(const std::vector<const ImageRecord*>& used) {
  std::set<const ImageRecord*> chosen;
  const int count = std::min(kProbes, static_cast<int>(used.size()));
  for (int i = 0; i < count; ++i) chosen.insert(used[i * (used.size() - 1) / std::max(1, count - 1)]);
  std::vector<const ImageRecord*> sorted(chosen.begin(), chosen.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
  return sorted;
}

// Null for a photograph that cannot be decoded: it is set aside, with its reason, when a tile needs it.
std::shared_ptr<const sweep::ImagePyramid> image_or_null(const ImageRecord& record, PhotoCache& photos) {
  try {
    return photos.get(record.name);
  } catch (const Error&) {
    return nullptr;
  }
}

std::optional<sweep::DepthProbe> probe(const ImageRecord& record, const std::vector<const ImageRecord*>& used,
                                       double typical_distance, PhotoCache& photos) {
  // Relative to the photograph itself: differences of snapped positions are exact wherever the scene lies.
  const auto view_of = [&](const ImageRecord& r, const sweep::ImagePyramid& image) {
    return sweep::View{&image, camera::Camera(r.model, r.pose).relative_to(record.pose.center), 0};
  };
  std::vector<std::shared_ptr<const sweep::ImagePyramid>> images;
  std::vector<sweep::View> neighbours;
  images.push_back(image_or_null(record, photos));
  if (!images.front()) return std::nullopt;
  for (const ImageRecord* other : others_by_distance(record, used)) {
    if (static_cast<int>(neighbours.size()) == kProbeNeighbours) break;
    if (distance_on_ground(record, *other) < kSamePlace * typical_distance) continue;
    auto image = image_or_null(*other, photos);
    if (!image) continue;
    neighbours.push_back(view_of(*other, *image));
    images.push_back(std::move(image));
  }
  return sweep::probe_depth(view_of(record, *images.front()), neighbours);
}

SearchRange around(double median_depth, double nearest_depth, double farthest_depth) {
  SearchRange search;
  search.ground_depth_m = median_depth;
  search.reach_depth_m = std::max(kReachOfMedian * median_depth, kReachOfFarthest * farthest_depth);
  search.nearest_depth_m = std::max(kNearestOfMedian * median_depth, kNearestOfNearest * nearest_depth);
  search.farthest_depth_m = search.reach_depth_m;
  return search;
}

SearchRange below_cameras(const std::vector<const ImageRecord*>& used, const sweep::HeightRange& heights) {
  std::vector<double> to_middle;
  double farthest = 0;
  for (const ImageRecord* record : used) {
    const double z = record->pose.center.z;
    if (z <= heights.z_low) continue;
    to_middle.push_back(std::max(z - 0.5 * (heights.z_low + heights.z_high), 0.5 * (z - heights.z_low)));
    farthest = std::max(farthest, z - heights.z_low);
  }
  if (to_middle.empty())
    throw bad_input(
        "All cameras are below the height range given by --z-range: heights and positions must be in the "
        "same vertical reference.");
  SearchRange search = around(median(to_middle), 0, farthest);
  search.heights = heights;
  return search;
}

// Two significant digits: short to read, and the same for the same flight on every machine.
double rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  const double digits = std::round(value / unit);
  // Dividing by a power of ten gives the double nearest to the decimal number; multiplying by 0.001 does not.
  return unit < 1 ? digits / std::round(1 / unit) : digits * std::round(unit);
}

}  // namespace

SearchRange estimate_search_range(const std::vector<ImageRecord>& records,
                                  const std::optional<sweep::HeightRange>& heights, PhotoCache& photos,
                                  Executor& executor) {
  const std::vector<const ImageRecord*> used = used_records(records);
  if (heights) return below_cameras(used, *heights);
  const double typical_distance = typical_neighbour_distance(used);
  if (typical_distance <= 0)
    throw bad_input("All photographs were taken from the same place: without a baseline no height can be measured.");

  const std::vector<const ImageRecord*> probed = probed_records(used);
  std::vector<std::optional<sweep::DepthProbe>> probes(probed.size());
  executor.parallel_for(static_cast<int>(probed.size()),
                        [&](int i) { probes[i] = probe(*probed[i], used, typical_distance, photos); });
  std::vector<double> medians, farthest;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& found : probes) {
    if (!found) continue;
    medians.push_back(found->median_m);
    farthest.push_back(found->farthest_m);
    nearest = std::min(nearest, found->nearest_m);
  }
  if (medians.empty())
    throw bad_input(
        "The photographs' overlap could not be found: neighbouring photographs show no common ground at any "
        "height. Check that the poses belong to these photographs, or give --z-range LOW,HIGH.");
  return around(quantile(medians, 0.5), nearest, quantile(farthest, kFarthestQuantile));
}

double default_cell(const std::vector<ImageRecord>& records, const SearchRange& search) {
  std::vector<double> gsds;
  for (const ImageRecord* record : used_records(records))
    gsds.push_back(search.ground_depth_m / record->model.focal_px());
  return rounded(median(gsds));
}

double default_plane_step(const std::vector<ImageRecord>& records, const SearchRange& search, double plane_step_px) {
  const std::vector<const ImageRecord*> used = used_records(records);
  std::vector<double> steps;
  for (const ImageRecord* record : used) {
    double ratio = kSmallestBaselineRatio;
    for (const ImageRecord* other : others_by_distance(*record, used)) {
      const double r = distance_on_ground(*record, *other) / search.ground_depth_m;
      if (r > kLargestBaselineRatio) break;
      ratio = std::max(ratio, r);
    }
    steps.push_back(plane_step_px * search.ground_depth_m / record->model.focal_px() / ratio);
  }
  return rounded(median(steps));
}

}  // namespace skysweep::pipeline
