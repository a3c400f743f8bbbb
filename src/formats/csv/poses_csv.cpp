// SPDX-License-Identifier: Apache-2.0
#include "formats/csv/poses_csv.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

#include "core/error.h"
#include "formats/collect/pose_collector.h"
#include "formats/csv/camera_columns.h"
#include "formats/csv/camera_table.h"
#include "formats/csv/poses_table.h"
#include "formats/text/csv_table.h"

namespace skysweep::formats {
namespace {

using Names = std::vector<std::string_view>;

const Names kPosition = {"image", "x", "y", "z"};

// One way to write a rotation.
struct RotationForm {
  Names columns;
  Mat3d (*read)(const CsvRecord&);
};

Mat3d read_yaw_pitch_roll(const CsvRecord& r) {
  return camera::rotation_from_yaw_pitch_roll(r.number("yaw"), r.number("pitch"), r.number("roll"));
}

Mat3d read_omega_phi_kappa(const CsvRecord& r) {
  return camera::rotation_from_omega_phi_kappa(r.number("omega"), r.number("phi"), r.number("kappa"));
}

Mat3d read_quaternion(const CsvRecord& r) {
  const auto rotation =
      camera::rotation_from_quaternion(r.number("qw"), r.number("qx"), r.number("qy"), r.number("qz"));
  if (!rotation) throw bad_input(r.where() + ": the quaternion (qw, qx, qy, qz) has not the length 1.");
  return *rotation;
}

const std::vector<RotationForm> kRotationForms = {{{"yaw", "pitch", "roll"}, read_yaw_pitch_roll},
                                                  {{"omega", "phi", "kappa"}, read_omega_phi_kappa},
                                                  {{"qw", "qx", "qy", "qz"}, read_quaternion}};

// The one rotation that the header declares.
const RotationForm& rotation_form(const CsvTable& table) {
  const RotationForm* found = nullptr;
  const RotationForm* begun = nullptr;
  for (const RotationForm& form : kRotationForms) {
    const std::size_t missing = table.missing(form.columns).size();
    if (missing > 0 && missing < form.columns.size()) begun = &form;
    if (missing > 0) continue;
    if (found)
      throw bad_input(table.where() + ": the rotation is given twice, by " + enumeration(found->columns) + " and by " +
                      enumeration(form.columns) + "; keep one of the two.");
    found = &form;
  }
  if (found) return *found;
  if (begun)
    throw bad_input(table.where() + ": the rotation needs the column(s) " + enumeration(table.missing(begun->columns)) +
                    " too; add them.");
  throw bad_input(table.where() +
                  ": no columns for the rotation; add yaw, pitch, roll or omega, phi, kappa or qw, qx, qy, qz.");
}

// Where the cameras of the file come from: its own columns, or a cameras.csv beside it.
struct CameraSource {
  Names columns;  // of poses.csv that it reads
  std::function<camera::CameraModel(const CsvRecord&)> camera_of;
};

CameraSource camera_source(const CsvTable& table) {
  if (const CameraColumns form = camera_columns(table); form != CameraColumns::none)
    return {names_of(form), [form](const CsvRecord& record) { return read_camera(record, form); }};

  const std::filesystem::path beside = std::filesystem::path(table.path).parent_path() / "cameras.csv";
  if (!std::filesystem::exists(beside))
    throw bad_input(table.where() +
                    ": no camera; add the columns focal_mm, sensor_width_mm, width, height or fx, fy, "
                    "cx, cy, width, height, or put them into a file cameras.csv beside this one.");
  const auto cameras = std::make_shared<const CameraTable>(beside.string());
  if (table.has("camera"))
    return {{"camera"},
            [cameras](const CsvRecord& record) { return cameras->named(record.text("camera"), record.where()); }};
  const camera::CameraModel only = cameras->only(table.where());
  return {{}, [only](const CsvRecord&) { return only; }};
}

// The columns that nothing is read from, as a sentence; empty if there are none.
std::string ignored_columns(const CsvTable& table, const Names& read) {
  Names ignored;
  for (const std::string& column : table.columns)
    if (!column.empty() && std::find(read.begin(), read.end(), column) == read.end()) ignored.push_back(column);
  if (ignored.empty()) return {};
  return table.where() + ": nothing was read from the column(s) " + enumeration(ignored) + ".";
}

}  // namespace

PoseSet read_poses_csv(const std::string& path) { return poses_of_table(read_csv(path)); }

PoseSet poses_of_table(const CsvTable& table) {
  if (const Names missing = table.missing(kPosition); !missing.empty())
    throw bad_input(table.where() + ": the column(s) " + enumeration(missing) +
                    " are missing; the header must name image, x, y, z, a rotation and a camera.");
  const RotationForm& rotation = rotation_form(table);
  const CameraSource cameras = camera_source(table);

  Names read = kPosition;
  read.insert(read.end(), rotation.columns.begin(), rotation.columns.end());
  read.insert(read.end(), cameras.columns.begin(), cameras.columns.end());
  table.require_unique(read);

  PoseCollector collector(table.path);
  if (std::string sentence = ignored_columns(table, read); !sentence.empty()) collector.note(std::move(sentence));
  const std::size_t name_column = *table.index_of("image");
  for (const CsvTable::Row& row : table.rows) {
    const CsvRecord record(table, row);
    const std::string name = name_column < row.fields.size() ? row.fields[name_column] : "";
    try {
      record.require_complete();
      const Vec3d center{record.number("x"), record.number("y"), record.number("z")};
      collector.add({name, cameras.camera_of(record), {rotation.read(record), center}, record.where()});
    } catch (const Error& error) {
      collector.refuse(name, record.where(), error.what());
    }
  }
  return std::move(collector).finish();
}

}  // namespace skysweep::formats
