// SPDX-License-Identifier: Apache-2.0
#include "formats/check_points.h"

#include <filesystem>

#include "core/error.h"
#include "formats/colmap/records.h"
#include "formats/text/csv_table.h"

namespace skysweep::formats {
namespace {

namespace fs = std::filesystem;

struct PointsFile {
  fs::path path;
  colmap::Encoding encoding;
};

// The points of a COLMAP model, if `path` is one.
std::optional<PointsFile> colmap_points(const fs::path& path) {
  if (!fs::is_directory(path)) {
    if (path.filename() == "points3D.bin") return PointsFile{path, colmap::Encoding::binary};
    if (path.filename() == "points3D.txt") return PointsFile{path, colmap::Encoding::text};
    return std::nullopt;
  }
  for (const fs::path& folder : {path, path / "sparse" / "0", path / "sparse"}) {
    if (fs::exists(folder / "points3D.bin")) return PointsFile{folder / "points3D.bin", colmap::Encoding::binary};
    if (fs::exists(folder / "points3D.txt")) return PointsFile{folder / "points3D.txt", colmap::Encoding::text};
  }
  throw bad_input(path.string() + ": no points3D.txt or points3D.bin is in this folder.");
}

bool passes(const colmap::PointRecord& point, const CheckPointFilter& filter) {
  if (filter.min_track_length && static_cast<double>(point.track_length) < *filter.min_track_length) return false;
  return !filter.max_reprojection_error_px || point.reprojection_error_px <= *filter.max_reprojection_error_px;
}

std::vector<CheckPoint> read_colmap(const PointsFile& file, const CheckPointFilter& filter) {
  std::vector<CheckPoint> points;
  colmap::read_points(file.path.string(), file.encoding, [&](const colmap::PointRecord& point) {
    if (passes(point, filter)) points.push_back({point.position, std::to_string(point.id)});
  });
  return points;
}

std::vector<CheckPoint> read_table(const std::string& path) {
  const CsvTable table = read_csv(path);
  if (const auto missing = table.missing({"x", "y", "z"}); !missing.empty())
    throw bad_input(table.where() + ": the column(s) " + enumeration(missing) +
                    " are missing; check points have the columns x, y, z and optionally id.");
  table.require_unique({"x", "y", "z", "id"});
  std::vector<CheckPoint> points;
  for (const CsvTable::Row& row : table.rows) {
    const CsvRecord record(table, row);
    record.require_complete();
    points.push_back(
        {{record.number("x"), record.number("y"), record.number("z")}, table.has("id") ? record.text("id") : ""});
  }
  return points;
}

}  // namespace

std::vector<CheckPoint> read_check_points(const std::string& path, const CheckPointFilter& filter, Vec3d origin) {
  std::optional<PointsFile> model;
  try {
    if (!fs::exists(path)) throw bad_input(path + ": there is no such file or folder of check points.");
    model = colmap_points(path);
  } catch (const fs::filesystem_error& error) {
    throw bad_input(path + ": cannot be opened (" + error.code().message() + ").");
  }
  if (!model && (filter.min_track_length || filter.max_reprojection_error_px))
    throw usage_error(path +
                      ": track length and reprojection error are known of a COLMAP model's points only; leave the "
                      "filter out.");
  std::vector<CheckPoint> points = model ? read_colmap(*model, filter) : read_table(path);
  for (CheckPoint& point : points) point.position = point.position + origin;
  return points;
}

}  // namespace skysweep::formats
