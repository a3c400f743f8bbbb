// SPDX-License-Identifier: Apache-2.0
#include "formats/csv/camera_table.h"

#include "core/error.h"
#include "formats/csv/camera_columns.h"
#include "formats/text/csv_table.h"

namespace skysweep::formats {

CameraTable::CameraTable(const std::string& path) : path_(path) {
  const CsvTable table = read_csv(path);
  const CameraColumns form = camera_columns(table);
  if (form == CameraColumns::none)
    throw bad_input(table.where() +
                    ": no camera columns; add focal_mm, sensor_width_mm, width, height or fx, fy, cx, cy, width, "
                    "height.");
  if (table.rows.empty()) throw bad_input(path + ": holds no cameras; add a row for each.");
  table.require_unique({"camera"});
  if (!table.has("camera") && table.rows.size() > 1)
    throw bad_input(table.where() + ": several cameras need a column 'camera' with their names; add it.");

  for (const CsvTable::Row& row : table.rows) {
    const CsvRecord record(table, row);
    record.require_complete();
    const std::string name = table.has("camera") ? record.text("camera") : "";
    Entry entry{{}, record.where(), ""};
    try {
      entry.model = read_camera(record, form);
    } catch (const Error& error) {
      entry.problem = error.what();
    }
    const auto [first, is_new] = cameras_.try_emplace(name, entry);
    if (!is_new)
      first->second.problem =
          first->second.place + " and " + entry.place + " both define camera '" + name + "'; keep one of them.";
  }
}

const camera::CameraModel& CameraTable::named(const std::string& name, const std::string& where) const {
  const auto found = cameras_.find(name);
  if (found == cameras_.end())
    throw bad_input(where + ": camera '" + name + "' is not in " + path_ + "; add a row for it or correct the name.");
  return usable(name, found->second, where);
}

const camera::CameraModel& CameraTable::only(const std::string& where) const {
  if (cameras_.size() != 1)
    throw bad_input(where + ": " + path_ + " holds " + std::to_string(cameras_.size()) +
                    " cameras; add a column 'camera' that names one of them in each row.");
  return usable(cameras_.begin()->first, cameras_.begin()->second, where);
}

const camera::CameraModel& CameraTable::usable(const std::string& name, const Entry& entry, const std::string& where) {
  if (!entry.problem.empty()) throw bad_input(where + ": its camera '" + name + "' cannot be used: " + entry.problem);
  return entry.model;
}

}  // namespace skysweep::formats
