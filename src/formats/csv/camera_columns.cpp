// SPDX-License-Identifier: Apache-2.0
#include "formats/csv/camera_columns.h"

#include <cmath>

#include "core/check.h"
#include "core/error.h"

namespace skysweep::formats {
namespace {

using Names = std::vector<std::string_view>;

// How far fx and fy may differ. No aerial camera has pixels that are less square; what has is a photograph cropped from
// its sensor (a 16:9 frame of a 4:3 sensor) whose height is given as that of the whole sensor.
constexpr double kSquarePixels = 0.02;

// The column, or the middle of the photograph if there is none.
double middle_or(const CsvRecord& record, std::string_view column, int size_px) {
  return record.number_or(column, 0.5 * size_px);
}

camera::CameraModel read_millimetres(const CsvRecord& record) {
  const double focal_mm = record.number("focal_mm");
  const double sensor_width_mm = record.number("sensor_width_mm");
  if (!(sensor_width_mm > 0)) throw bad_input(record.where() + ": the sensor width must be positive.");
  camera::CameraModel model =
      camera::camera_from_sensor(focal_mm, sensor_width_mm, record.size("width"), record.size("height"));
  model.cx_px = middle_or(record, "cx", model.width_px);
  model.cy_px = middle_or(record, "cy", model.height_px);
  const double pixel_mm = sensor_width_mm / model.width_px;
  const double sensor_height_mm = record.number_or("sensor_height_mm", pixel_mm * model.height_px);
  if (!(sensor_height_mm > 0)) throw bad_input(record.where() + ": the sensor height must be positive.");
  model.fy_px = focal_mm * model.height_px / sensor_height_mm;
  if (std::abs(model.fy_px / model.fx_px - 1) > kSquarePixels)
    throw bad_input(record.where() +
                    ": sensor size and image size give pixels that are not square; if the photograph is a crop of the "
                    "sensor, leave out sensor_height_mm.");
  return model;
}

camera::CameraModel read_pixels(const CsvRecord& record) {
  return {record.size("width"),
          record.size("height"),
          record.number("fx"),
          record.number("fy"),
          record.number("cx"),
          record.number("cy"),
          {}};
}

}  // namespace

CameraColumns camera_columns(const CsvTable& table) {
  const bool millimetres = table.has("focal_mm") || table.has("sensor_width_mm");
  const bool pixels = table.has("fx") || table.has("fy");
  if (!millimetres && !pixels) return CameraColumns::none;
  if (millimetres && pixels)
    throw bad_input(table.where() +
                    ": the camera is given both in millimetres (focal_mm, sensor_width_mm) and in pixels (fx, fy); "
                    "keep one of the two.");
  const Names required = millimetres ? Names{"focal_mm", "sensor_width_mm", "width", "height"}
                                     : Names{"fx", "fy", "cx", "cy", "width", "height"};
  if (const Names missing = table.missing(required); !missing.empty())
    throw bad_input(table.where() + ": the camera needs the column(s) " + enumeration(missing) + " too; add them.");
  const CameraColumns form = millimetres ? CameraColumns::millimetres : CameraColumns::pixels;
  table.require_unique(names_of(form));
  return form;
}

std::vector<std::string_view> names_of(CameraColumns form) {
  switch (form) {
    case CameraColumns::none: return {};
    case CameraColumns::millimetres:
      return {"focal_mm", "sensor_width_mm", "sensor_height_mm", "cx", "cy", "width", "height", "k1", "k2", "p1", "p2",
              "k3"};
    case CameraColumns::pixels: return {"fx", "fy", "cx", "cy", "width", "height", "k1", "k2", "p1", "p2", "k3"};
  }
  return {};
}

camera::CameraModel read_camera(const CsvRecord& record, CameraColumns form) {
  SKY_CHECK(form != CameraColumns::none);
  camera::CameraModel model = form == CameraColumns::millimetres ? read_millimetres(record) : read_pixels(record);
  model.distortion = {record.number_or("k1", 0), record.number_or("k2", 0), record.number_or("p1", 0),
                      record.number_or("p2", 0), record.number_or("k3", 0)};
  if (const auto problem = model.problem())
    throw bad_input(record.where() + ": the camera cannot be used: " + *problem + ".");
  return model;
}

}  // namespace skysweep::formats
