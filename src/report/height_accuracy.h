// SPDX-License-Identifier: Apache-2.0
// How accurate a surface model is: its heights against a true surface or against surveyed points. An error dz is
// measured minus true height, metres. Robust figures follow Hoehle and Hoehle 2009 (ISPRS J. 64): surface models have
// outliers, and RMSE alone says little about the rest.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"
#include "raster/geotiff.h"
#include "report/height_differences.h"

namespace skysweep::report {

// Tolerances, in photographs' GSD, for which the share of heights inside is reported.
inline constexpr std::array<double, 4> kTolerancesGsd = {1, 2, 3, 6};

struct HeightErrors {
  std::int64_t reference_count = 0;  // cells or points with a true height
  std::int64_t valid_count = 0;      // of these: with a measured height
  // NaN where there is no measured height at all.
  double mean_m = 0;             // bias
  double median_m = 0;           // bias that outliers do not move
  double rmse_m = 0;             // root mean square of dz
  double median_absolute_m = 0;  // median of |dz|
  double nmad_m = 0;             // 1.4826 median |dz - median dz|: equals sigma if dz is normal
  double le68_m = 0;             // 68.3 % of |dz| are at most this
  double le90_m = 0;             // 90 % of |dz| are at most this
  // Share with |dz| <= kTolerancesGsd[i] * GSD; NaN where nothing was counted.
  std::array<double, 4> within_of_all{};    // holes count as misses
  std::array<double, 4> within_of_valid{};  // among measured heights

  // Completeness: share of reference heights that have a measured one; NaN without reference.
  double valid_share() const;
};

struct HeightAccuracy {
  double gsd_m = 0;  // ground sampling distance of the photographs
  HeightErrors overall;
  std::optional<HeightErrors> masked;  // inside the mask, if one was given
};

struct AccuracyOptions {
  double gsd_m = 0;  // > 0: ground sampling distance of the photographs (not the side of an output cell)
};

// Figures of the dz of all measured heights (none of them NaN; single precision is plenty for differences and halves
// the memory). `reference_count` counts the holes, too.
HeightErrors height_errors(std::vector<float> dz, std::int64_t reference_count, double gsd_m);

// The surface at every cell that has a true height. `mask` (may be null) is of the cells' size; a cell is inside where
// it is above 0. Throws Error(usage) if the GSD is not positive.
HeightAccuracy accuracy_of(const HeightDifferences& cells, const Array2d<std::uint8_t>* mask,
                           const AccuracyOptions& options);

// The same from two rasters. If both rasters lie on one lattice, cell by cell; else the
// DSM is interpolated bilinearly at the centre of the truth's cell, which needs all four neighbours known. `mask` (may
// be null) lies on the truth's grid; a cell is inside where it is above 0.
// Throws Error(usage) if the CRSs differ, the mask lies elsewhere, or the GSD is not positive.
HeightAccuracy compare_surfaces(const raster::Raster<float>& dsm, const raster::Raster<float>& truth,
                                const raster::Raster<std::uint8_t>* mask, const AccuracyOptions& options);

// Measured minus true height, the surface interpolated bilinearly, at points given in its CRS; NaN outside and in
// holes.
std::vector<float> point_differences(const raster::Raster<float>& dsm, const std::vector<Vec3d>& points);

// Figures of these: NaN counts as a hole.
HeightAccuracy accuracy_of(const std::vector<float>& point_differences, const AccuracyOptions& options);

// Both in one.
HeightAccuracy compare_points(const raster::Raster<float>& dsm, const std::vector<Vec3d>& points,
                              const AccuracyOptions& options);

// A table for people, in metres and GSD; ends with a line break.
std::string to_text(const HeightAccuracy& accuracy);

// The same for machines; what is not known is null. Lengths in metres (names end in _m) and in GSD (_gsd).
std::string to_json(const HeightAccuracy& accuracy);

}  // namespace skysweep::report
