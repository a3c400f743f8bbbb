// SPDX-License-Identifier: Apache-2.0
#include "raster/gdal/labels.h"

#include <cmath>

#include "core/check.h"
#include "raster/crs.h"
#include "raster/gdal/spatial_reference.h"

namespace skysweep::raster {

namespace {

constexpr const char* kContent = "CONTENT";
constexpr const char* kVerticalReference = "VERTICAL_REFERENCE";
constexpr const char* kInputDigest = "INPUT_DIGEST";
constexpr const char* kSearchedHeights = "SEARCHED_HEIGHTS";
constexpr const char* kSoftware = "TIFFTAG_SOFTWARE";

void put_item(GDALDataset& dataset, const char* key, const std::string& value) {
  if (!value.empty()) dataset.SetMetadataItem(key, value.c_str());
}

std::string item_of(GDALDataset& dataset, const char* key) {
  const char* value = dataset.GetMetadataItem(key);
  return value ? value : "";
}

}  // namespace

void put_georeference(GDALDataset& dataset, const GeoReference& georeference) {
  SKY_CHECK(!georeference.crs_wkt.empty());
  SKY_CHECK_GT(georeference.cell_m, 0.0);
  const Vec2d corner = georeference.north_west_corner;
  double transform[6] = {corner.x, georeference.cell_m, 0, corner.y, 0, -georeference.cell_m};
  dataset.SetGeoTransform(transform);
  const OGRSpatialReference crs = spatial_reference_of(georeference.crs_wkt);
  dataset.SetSpatialRef(&crs);
}

void put_labels(GDALDataset& dataset, const Labels& labels) {
  put_item(dataset, kContent, labels.content);
  put_item(dataset, kVerticalReference, labels.vertical_reference);
  put_item(dataset, kInputDigest, labels.input_digest);
  put_item(dataset, kSearchedHeights, labels.searched_heights);
  put_item(dataset, kSoftware, labels.software);
  if (dataset.GetRasterCount() != 1) return;  // the bands of a colour image say by themselves what they are
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (!labels.content.empty()) band.SetDescription(labels.content.c_str());
  if (!labels.units.empty()) band.SetUnitType(labels.units.c_str());
}

Labels labels_of(GDALDataset& dataset) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  // Under a compound CRS GDAL gives the unit of the heights to every band, even to colours and classes.
  const bool measures = band.GetRasterDataType() != GDT_Byte;
  return {.content = item_of(dataset, kContent),
          .units = measures ? band.GetUnitType() : "",
          .vertical_reference = item_of(dataset, kVerticalReference),
          .software = item_of(dataset, kSoftware),
          .input_digest = item_of(dataset, kInputDigest),
          .searched_heights = item_of(dataset, kSearchedHeights)};
}

std::optional<GeoReference> georeference_of(GDALDataset& dataset, std::string& problem) {
  double t[6];
  if (dataset.GetGeoTransform(t) != CE_None) {
    problem = "has no georeference: it does not say where on the ground it lies";
    return std::nullopt;
  }
  // Text formats round the cell's size; a thousandth of a cell over the whole raster does no harm.
  const double tolerance = 1e-3 * std::abs(t[1]) / std::max(dataset.GetRasterXSize(), dataset.GetRasterYSize());
  if (std::abs(t[2]) > tolerance || std::abs(t[4]) > tolerance || !(t[1] > 0) || !(t[5] < 0)) {
    problem = "is rotated or mirrored: bring it north-up with gdalwarp";
    return std::nullopt;
  }
  if (std::abs(t[1] + t[5]) > tolerance) {
    problem = "has cells that are not square: resample it with gdalwarp -tr";
    return std::nullopt;
  }
  const OGRSpatialReference* crs = dataset.GetSpatialRef();
  return GeoReference{.crs_wkt = crs && !crs->IsEmpty() ? wkt_of(*crs) : local_metric_crs(),
                      .north_west_corner = {t[0], t[3]},
                      .cell_m = t[1]};
}

}  // namespace skysweep::raster
