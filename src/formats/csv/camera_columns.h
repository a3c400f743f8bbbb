// SPDX-License-Identifier: Apache-2.0
// Cameras in the columns of a CSV file, of poses.csv itself or of a cameras.csv beside it: in millimetres
//   focal_mm, sensor_width_mm [, sensor_height_mm] [, cx, cy], width, height
// or in pixels
//   fx, fy, cx, cy, width, height
// and in both cases optionally k1, k2, p1, p2, k3 (camera/camera_model.h says what they mean).
#pragma once

#include <string_view>
#include <vector>

#include "camera/camera_model.h"
#include "formats/text/csv_table.h"

namespace skysweep::formats {

enum class CameraColumns { none, millimetres, pixels };

// Which form of camera the header declares: decided by the columns that hold a focal length. Throws Error(bad_input)
// if it declares both forms or one of them incompletely.
CameraColumns camera_columns(const CsvTable& table);

// Every column that a camera of this form is read from.
std::vector<std::string_view> names_of(CameraColumns form);

// The camera of one row; throws Error(bad_input) if it cannot be used. `form` is not `none`.
camera::CameraModel read_camera(const CsvRecord& record, CameraColumns form);

}  // namespace skysweep::formats
