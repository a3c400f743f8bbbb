// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue/schema.h"

#include "core/error.h"

namespace skysweep::index {
namespace {

struct Column {
  const char* name;
  OGRFieldType type;
};

struct LayerSchema {
  const char* name;
  OGRwkbGeometryType geometry;
  std::vector<Column> columns;
  const char* index_sql;
};

std::vector<LayerSchema> schema() {
  LayerSchema images{"images",
                     wkbPolygon,
                     {{"name", OFTString},
                      {"status", OFTString},
                      {"reason", OFTString},
                      {"view_class", OFTString},
                      {"off_nadir_deg", OFTReal},
                      {"camera", OFTInteger64},  // fid in `cameras`
                      {"focal_px", OFTReal}},
                     "CREATE UNIQUE INDEX images_name ON images (name)"};
  for (const char* name : kPoseColumns) images.columns.push_back({name, OFTReal});
  // For people and other programs; the rotation is read back from its rows.
  for (const char* name : {"qw", "qx", "qy", "qz"}) images.columns.push_back({name, OFTReal});
  images.columns.push_back({"digest", OFTString});
  images.columns.push_back({"file_bytes", OFTInteger64});
  images.columns.push_back({"stamp", OFTString});

  LayerSchema cameras{"cameras", wkbNone, {}, nullptr};
  for (std::size_t i = 0; i < kCameraColumns.size(); ++i)
    cameras.columns.push_back({kCameraColumns[i], i < 2 ? OFTInteger : OFTReal});

  const LayerSchema tiles{"tiles",
                          wkbPolygon,
                          {{"name", OFTString},
                           {"level", OFTInteger},
                           {"digest", OFTString},
                           {"view_count", OFTInteger},
                           {"views", OFTString},  // JSON array of names
                           {"valid_share", OFTReal},
                           {"z_low", OFTReal},
                           {"z_high", OFTReal},
                           {"seconds", OFTReal},
                           {"candidates_digest", OFTString},
                           {"view_digests", OFTString},  // JSON array, one per view
                           {"checksum", OFTString},
                           {"stamp", OFTString}},
                          "CREATE UNIQUE INDEX tiles_name ON tiles (name)"};
  const LayerSchema products{"products",
                             wkbNone,
                             {{"name", OFTString}, {"digest", OFTString}, {"stamp", OFTString}},
                             "CREATE UNIQUE INDEX products_name ON products (name)"};
  return {images, cameras, tiles, products};
}

}  // namespace

OGRSpatialReference catalogue_crs(const std::string& wkt) {
  OGRSpatialReference crs;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (crs.importFromWkt(wkt.c_str()) != OGRERR_NONE)
    throw bad_input("the coordinate reference system of the catalogue cannot be understood: " + wkt);
  if (!crs.IsLocal()) return crs;
  // GeoPackage keeps old-style WKT, in which a local frame has two axes.
  const char* name = crs.GetName();
  OGRSpatialReference flat;
  flat.SetLocalCS(name ? name : "local metric frame");
  flat.SetLinearUnits("metre", 1);
  return flat;
}

void make_layers(GDALDataset& dataset, const OGRSpatialReference& crs) {
  OGRSpatialReference spatial_reference = crs;  // GDAL 3.6 asks for one that it might change
  for (const LayerSchema& layer_schema : schema()) {
    const bool is_table = layer_schema.geometry == wkbNone;
    OGRLayer* layer =
        dataset.CreateLayer(layer_schema.name, is_table ? nullptr : &spatial_reference, layer_schema.geometry, nullptr);
    if (!layer) return;
    for (const Column& column : layer_schema.columns) {
      OGRFieldDefn field(column.name, column.type);
      if (layer->CreateField(&field) != OGRERR_NONE) return;
    }
    if (layer_schema.index_sql) for_each_row(dataset, layer_schema.index_sql, [](const OGRFeature&) {});
  }
}

std::string what_is_missing(GDALDataset& dataset) {
  for (const LayerSchema& layer_schema : schema()) {
    OGRLayer* layer = dataset.GetLayerByName(layer_schema.name);
    if (!layer) return std::string("has no layer ") + layer_schema.name;
    for (const Column& column : layer_schema.columns)
      if (layer->GetLayerDefn()->GetFieldIndex(column.name) < 0)
        return std::string("has no column ") + column.name + " in its layer " + layer_schema.name;
  }
  return "";
}

}  // namespace skysweep::index
