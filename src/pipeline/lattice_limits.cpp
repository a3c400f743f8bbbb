// SPDX-License-Identifier: Apache-2.0
#include "pipeline/lattice_limits.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/box.h"
#include "core/error.h"

namespace skysweep::pipeline {
namespace {

// Tile indices are packed into 29 bits; photographs reach some tiles beyond their own positions.
constexpr double kFarthestTile = 1 << 27;
constexpr double kMostTilesOfPhotograph = 1e5;
// More planes than a tile can hold in memory; the deepest real scene, 3 km of mountain at a step of 0.1 m, has 30,000.
constexpr double kMostPlanes = 1e5;
constexpr double kFarthestPlane = 1 << 30;  // plane numbers are 32-bit
constexpr double kSnap = 0x1p-20;           // of positions, metres (camera::snap_position)
constexpr double kFewestSnapsOfCell = 16;   // a cell this many of them across is moved by 3 % of its size at most
// Clusters this far apart are no single flight: a UTM zone's width is 300 to 670 km.
constexpr double kFarApart_m = 1e5;

std::string number(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

struct Extent {
  Box2d ground;
  double z_low = 0, z_high = 0;
  bool empty = true;
};

Extent extent_of_cameras(const std::vector<index::ImageRecord>& records) {
  Extent out;
  for (const index::ImageRecord& record : records) {
    if (record.status != index::ImageStatus::used) continue;
    const Vec3d c = record.pose.center;
    out.ground.extend({c.x, c.y});
    out.z_low = out.empty ? c.z : std::min(out.z_low, c.z);
    out.z_high = out.empty ? c.z : std::max(out.z_high, c.z);
    out.empty = false;
  }
  return out;
}

sweep::HeightRange heights_searched(const Extent& cameras, const SearchRange& search) {
  if (search.heights) return *search.heights;
  return {cameras.z_low - search.farthest_depth_m, cameras.z_high - search.nearest_depth_m};
}

double largest_coordinate(const Box2d& box) {
  return std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
}

// Positions along one axis in order; a sentence where two neighbours are far apart, naming a photograph on the side
// that holds fewer.
void warn_of_gap(std::vector<const index::ImageRecord*> used, double Vec3d::*axis, const char* direction,
                 std::vector<std::string>& warnings) {
  std::sort(used.begin(), used.end(), [axis](const auto* a, const auto* b) {
    return a->pose.center.*axis != b->pose.center.*axis ? a->pose.center.*axis < b->pose.center.*axis
                                                        : a->name < b->name;
  });
  for (std::size_t i = 1; i < used.size(); ++i) {
    const double gap = used[i]->pose.center.*axis - used[i - 1]->pose.center.*axis;
    if (gap < kFarApart_m) continue;
    const bool west_is_smaller = i <= used.size() - i;
    warnings.push_back(
        std::to_string(west_is_smaller ? i : used.size() - i) + " of " + std::to_string(used.size()) +
        " photographs, " + used[west_is_smaller ? i - 1 : i]->name + " among them, lie " + number(gap / 1000) + " km " +
        direction +
        " of the others and cannot be matched with them: a position without a fix, or one of another UTM "
        "zone? Give all positions in one CRS; a flight across a zone border belongs into one zone.");
  }
}

}  // namespace

void require_countable_lattice(const std::vector<index::ImageRecord>& records, const ProjectSettings& settings) {
  const tiles::Lattice& lattice = settings.lattice;
  const Extent cameras = extent_of_cameras(records);
  if (cameras.empty) return;
  const double tile_m = lattice.tile_size_m(0);
  if (!(tile_m > 0) || !(largest_coordinate(cameras.ground) / tile_m < kFarthestTile))
    throw usage_error("The photographs lie " + number(largest_coordinate(cameras.ground)) +
                      " m from the origin, too far to number tiles of " + number(tile_m) + " m (cells of " +
                      number(lattice.cell_m) + " m): give a larger --cell, or an --origin that brings them nearer.");
  const double width_in_tiles = settings.search.reach_depth_m / tile_m;
  if (!(width_in_tiles * width_in_tiles < kMostTilesOfPhotograph))
    throw usage_error("With cells of " + number(lattice.cell_m) + " m one photograph from " +
                      number(settings.search.reach_depth_m) + " m would cover about " +
                      number(width_in_tiles * width_in_tiles) + " tiles: give a larger --cell.");
  const sweep::HeightRange heights = heights_searched(cameras, settings.search);
  const double planes = (heights.z_high - heights.z_low) / lattice.dz_m;
  if (!(lattice.dz_m > 0) || !(planes < kMostPlanes))
    throw usage_error("Heights from " + number(heights.z_low) + " m to " + number(heights.z_high) + " m in steps of " +
                      number(lattice.dz_m) + " m make " + number(planes) + " planes, more than " + number(kMostPlanes) +
                      ": give a larger --dz or a narrower --z-range.");
  const double farthest = std::max(std::abs(heights.z_low), std::abs(heights.z_high));
  if (!(farthest / lattice.dz_m < kFarthestPlane))
    throw usage_error("Heights of " + number(farthest) + " m cannot be numbered in steps of " + number(lattice.dz_m) +
                      " m: give a larger --dz, or an --origin that brings heights near zero.");
}

std::vector<std::string> resolution_warnings(const std::vector<index::ImageRecord>& records,
                                             const ProjectSettings& settings) {
  std::vector<std::string> warnings;
  const Extent cameras = extent_of_cameras(records);
  if (cameras.empty) return warnings;
  const tiles::Lattice& lattice = settings.lattice;
  if (lattice.cell_m < kFewestSnapsOfCell * kSnap)
    warnings.push_back("Cells of " + number(lattice.cell_m) + " m come near the " + number(kSnap) +
                       " m to which camera positions are rounded, so heights and places may be off by a part of a "
                       "cell: give the model in a smaller unit, a thousand times as large.");
  const sweep::HeightRange heights = heights_searched(cameras, settings.search);
  const double farthest = std::max(std::abs(heights.z_low), std::abs(heights.z_high));
  const double resolution = static_cast<double>(std::nextafter(static_cast<float>(farthest), HUGE_VALF)) -
                            static_cast<double>(static_cast<float>(farthest));
  if (resolution > lattice.dz_m)
    warnings.push_back("Heights around " + number(farthest) + " m are stored to " + number(resolution) +
                       " m only, coarser than the plane step of " + number(lattice.dz_m) +
                       " m: give an --origin that brings heights near zero.");
  return warnings;
}

std::vector<std::string> scatter_warnings(const std::vector<index::ImageRecord>& records) {
  std::vector<const index::ImageRecord*> used;
  for (const index::ImageRecord& record : records)
    if (record.status == index::ImageStatus::used) used.push_back(&record);
  std::vector<std::string> warnings;
  warn_of_gap(used, &Vec3d::x, "east or west", warnings);
  if (warnings.empty()) warn_of_gap(used, &Vec3d::y, "north or south", warnings);
  return warnings;
}

}  // namespace skysweep::pipeline
