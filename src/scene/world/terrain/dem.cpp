// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/dem.h"

#include <cmath>
#include <sstream>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/geotiff.h"

namespace skysweep::scene {

namespace {

void require_fits(const Scene& scene, const std::string& file, const raster::Raster<float>& dem) {
  const std::string& crs = dem.georeference.crs_wkt;
  if (!scene.crs.empty() && !raster::same_crs(crs, raster::local_metric_crs()) &&
      !raster::same_crs(crs, raster::crs_from_user_input(scene.crs)))
    throw usage_error(file + " is in " + raster::crs_name(crs) + ", but the scene in " + scene.crs +
                      ": bring it there with gdalwarp -t_srs");
  const Vec2d corner{scene.origin.x, scene.origin.y};
  const Box2d extent = dem.extent();
  if (extent.contains(corner) && extent.contains(corner + scene.area_m)) return;
  std::ostringstream text;
  text << std::fixed;
  text.precision(2);
  text << file << " covers x " << extent.min.x << " to " << extent.max.x << ", y " << extent.min.y << " to "
       << extent.max.y << ", but the scene maps x " << corner.x << " to " << corner.x + scene.area_m.x << ", y "
       << corner.y << " to " << corner.y + scene.area_m.y << ": set origin and area_m";
  throw usage_error(text.str());
}

}  // namespace

HeightGrid read_dem(const DemTerrain& shape, const Scene& scene) {
  const std::string file = shape.file.string();
  const raster::Raster<float> dem = raster::read_float_raster(shape.file);
  const int width = dem.values.width(), height = dem.values.height();
  if (width < 2 || height < 2) throw bad_input(file + " is no surface: it needs two rows and columns");
  require_fits(scene, file, dem);
  Array2d<double> z(width, height);
  int holes = 0;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const float value = dem.values(column, row);
      holes += !std::isfinite(value);
      z(column, height - 1 - row) = static_cast<double>(value) - scene.origin.z;
    }
  if (holes > 0)
    throw bad_input(file + " has no height in " + std::to_string(holes) +
                    " cells: crop it, or fill them with gdal_fillnodata.py");
  const double cell = dem.georeference.cell_m;
  const Vec2d south_west = dem.georeference.cell_center(0, height - 1) - Vec2d{scene.origin.x, scene.origin.y};
  return {z, south_west, {cell, cell}, HeightGrid::Beyond::border};
}

}  // namespace skysweep::scene
