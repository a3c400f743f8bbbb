// SPDX-License-Identifier: Apache-2.0
#include "raster/crs.h"

#include <ogr_spatialref.h>

#include <cmath>
#include <memory>

#include "core/error.h"
#include "raster/gdal/session.h"
#include "raster/gdal/spatial_reference.h"

namespace skysweep::raster {

namespace {

// WKT 1, because this is the form that survives the way through the keys of a GeoTIFF unchanged.
constexpr const char* kLocalWkt =
    "LOCAL_CS[\"local metric frame (no CRS given)\",UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]],"
    "AXIS[\"Easting\",EAST],AXIS[\"Northing\",NORTH]]";

bool is_metre(double metres_per_unit) { return std::abs(metres_per_unit - 1.0) < 1e-9; }

// "EPSG:32615", or nothing if no authority knows it.
std::string authority_code(const OGRSpatialReference& crs) {
  const char* authority = crs.GetAuthorityName(nullptr);
  const char* code = crs.GetAuthorityCode(nullptr);
  return authority && code ? std::string(authority) + ":" + code : std::string();
}

Error refusal(const std::string& text, const std::string& why) {
  return usage_error("the coordinate reference system \"" + text + "\" " + why);
}

void require_usable(const OGRSpatialReference& crs, const std::string& text) {
  if (crs.IsGeographic())
    throw refusal(text,
                  "is geographic (degrees), but maps are made in metres: use a projected one, e.g. the UTM zone "
                  "EPSG:32601-32660 (north) or EPSG:32701-32760 (south)");
  if (crs.IsGeocentric())
    throw refusal(text, "is geocentric, but maps are made on a plane: use a projected one, e.g. a UTM zone");
  if (!crs.IsProjected() && !crs.IsLocal())
    throw refusal(text, "has no horizontal part: use a projected one, e.g. a UTM zone such as EPSG:32632");
  const char* unit = nullptr;
  if (!is_metre(crs.GetLinearUnits(&unit)))
    throw refusal(text, "is in units of \"" + std::string(unit) +
                            "\", but maps are made in metres: use its variant in metres, or a UTM zone");
  if (crs.IsCompound() && !is_metre(crs.GetTargetLinearUnits("COMPD_CS|VERT_CS", &unit)))
    throw refusal(text, "has heights in units of \"" + std::string(unit) +
                            "\", but heights are in metres: use a vertical part in metres");
  // A projected system with a third axis of its own (WKT 2, or +vunits of a PROJ string) is not compound.
  for (int axis = 0; axis < crs.GetAxesCount(); ++axis) {
    OGRAxisOrientation direction{};
    double metres = 1;
    const char* name = crs.GetAxis(nullptr, axis, &direction, &metres);
    if (!is_metre(metres))
      throw refusal(text, "has its axis \"" + std::string(name ? name : "height") + "\" in units of " +
                              std::to_string(metres) + " m, but maps and heights are in metres: use metres");
  }
}

}  // namespace

OGRSpatialReference spatial_reference_of(const std::string& wkt) {
  OGRSpatialReference crs;
  crs.importFromWkt(wkt.c_str());
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

std::string wkt_of(const OGRSpatialReference& crs) {
  char* text = nullptr;
  crs.exportToWkt(&text);
  std::string wkt = text ? text : "";
  CPLFree(text);
  return wkt;
}

std::string crs_from_user_input(const std::string& text) {
  const GdalSession gdal;
  OGRSpatialReference crs;
  // Limited to what is named in the text itself: a typing mistake must not open files or web pages.
  if (text.empty() ||
      crs.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) != OGRERR_NONE)
    throw refusal(text, "is unknown: name it as \"EPSG:32632\", as WKT or as a PROJ string");
  require_usable(crs, text);
  return wkt_of(crs);
}

std::string local_metric_crs() { return kLocalWkt; }

std::string crs_name(const std::string& wkt) {
  const GdalSession gdal;
  const OGRSpatialReference crs = spatial_reference_of(wkt);
  const char* name = crs.GetName();
  const std::string shown = name && *name ? name : "unnamed";
  const std::string code = authority_code(crs);
  return code.empty() ? shown : shown + " (" + code + ")";
}

bool same_crs(const std::string& wkt_a, const std::string& wkt_b) {
  if (wkt_a == wkt_b) return true;
  const GdalSession gdal;
  const OGRSpatialReference b = spatial_reference_of(wkt_b);
  return spatial_reference_of(wkt_a).IsSame(&b) != 0;
}

std::optional<std::vector<Wgs84Position>> wgs84_positions(const std::string& wkt, const std::vector<Vec2d>& places) {
  const GdalSession gdal;
  const OGRSpatialReference from = spatial_reference_of(wkt);
  if (from.IsLocal()) return std::nullopt;
  OGRSpatialReference to;
  to.SetWellKnownGeogCS("WGS84");
  to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);  // longitude, latitude
  const std::unique_ptr<OGRCoordinateTransformation> transformation(OGRCreateCoordinateTransformation(&from, &to));
  if (!transformation)
    throw usage_error("there is no way from " + crs_name(wkt) + " to WGS 84: " + gdal.reason("PROJ"));
  std::vector<Wgs84Position> out;
  for (const Vec2d place : places) {
    double x = place.x, y = place.y;
    if (!transformation->Transform(1, &x, &y) || !std::isfinite(x) || !std::isfinite(y))
      throw usage_error("the place " + std::to_string(place.x) + ", " + std::to_string(place.y) +
                        " lies outside of what " + crs_name(wkt) + " covers");
    out.push_back({y, x});
  }
  return out;
}

std::string output_crs_from_user_input(const std::string& text, const std::string& map_wkt) {
  const GdalSession gdal;
  OGRSpatialReference crs;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (text.empty() ||
      crs.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) != OGRERR_NONE)
    throw refusal(text, "is unknown: name it as \"EPSG:32632\", as WKT or as a PROJ string");
  if (crs.IsCompound() || crs.IsVertical() || crs.GetAxesCount() > 2)
    throw refusal(text,
                  "has a vertical part, but heights are not converted: name the horizontal system alone, e.g. "
                  "EPSG:25832 in place of EPSG:25832+7837");
  if (!crs.IsProjected() && !crs.IsGeographic())
    throw refusal(text, "is neither projected nor geographic: use e.g. a UTM zone such as EPSG:32632, or EPSG:4326");
  const OGRSpatialReference map = spatial_reference_of(map_wkt);
  const OGR_SRSNode* vertical = map.IsCompound() ? map.GetAttrNode("COMPD_CS|VERT_CS") : nullptr;
  if (!vertical) return wkt_of(crs);
  char* vertical_wkt = nullptr;
  vertical->exportToWkt(&vertical_wkt);
  const OGRSpatialReference heights(vertical_wkt);
  CPLFree(vertical_wkt);
  OGRSpatialReference both;
  const std::string name = std::string(crs.GetName()) + " + " + heights.GetName();
  both.SetCompoundCS(name.c_str(), &crs, &heights);
  return wkt_of(both);
}

bool is_local_crs(const std::string& wkt) {
  const GdalSession gdal;
  return spatial_reference_of(wkt).IsLocal() != 0;
}

std::string esri_wkt(const std::string& wkt) {
  const GdalSession gdal;
  OGRSpatialReference crs = spatial_reference_of(wkt);
  if (crs.IsCompound()) crs.StripVertical();
  crs.morphToESRI();
  return wkt_of(crs);
}

Box2d transformed_extent(const std::string& from_wkt, const std::string& to_wkt, const Box2d& box) {
  if (from_wkt == to_wkt) return box;
  const GdalSession gdal;
  OGRSpatialReference from = spatial_reference_of(from_wkt), to = spatial_reference_of(to_wkt);
  if (from.IsCompound()) from.StripVertical();
  if (to.IsCompound()) to.StripVertical();
  const std::unique_ptr<OGRCoordinateTransformation> transformation(
      from.IsLocal() || to.IsLocal() ? nullptr : OGRCreateCoordinateTransformation(&from, &to));
  constexpr int kPointsPerSide = 21;
  Box2d out;
  if (!transformation ||
      !transformation->TransformBounds(box.min.x, box.min.y, box.max.x, box.max.y, &out.min.x, &out.min.y, &out.max.x,
                                       &out.max.y, kPointsPerSide) ||
      !std::isfinite(out.width()) || !std::isfinite(out.height()))
    throw usage_error("there is no way from " + crs_name(from_wkt) + " to " + crs_name(to_wkt) +
                      " for all of the area: choose a system that covers it");
  return out;
}

std::string vertical_reference(const std::string& wkt) {
  const GdalSession gdal;
  const OGRSpatialReference crs = spatial_reference_of(wkt);
  const char* name = crs.IsCompound() ? crs.GetAttrValue("COMPD_CS|VERT_CS") : nullptr;
  return name ? name : "unknown: as in the photographs' poses";
}

}  // namespace skysweep::raster
