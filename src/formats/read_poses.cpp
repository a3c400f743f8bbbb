// SPDX-License-Identifier: Apache-2.0
// Tells by looking which format a file or folder of poses has.
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "formats/colmap/model_folder.h"
#include "formats/csv/poses_csv.h"
#include "formats/opensfm/reconstruction.h"
#include "formats/pose_set.h"
#include "formats/text/line_reader.h"

namespace skysweep::formats {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAccepted =
    "accepted are a poses.csv, a COLMAP model folder (cameras and images, .txt or .bin) and an OpenSfM or ODM "
    "reconstruction.json.";

enum class Kind { csv, colmap, opensfm };

struct Source {
  Kind kind;
  fs::path path;
};

// What lies directly in the folder.
std::vector<Source> sources_directly_in(const fs::path& folder) {
  std::vector<Source> sources;
  if (colmap::model_encoding(folder.string())) sources.push_back({Kind::colmap, folder});
  if (fs::is_regular_file(folder / "reconstruction.json"))
    sources.push_back({Kind::opensfm, folder / "reconstruction.json"});
  if (fs::is_regular_file(folder / "poses.csv")) sources.push_back({Kind::csv, folder / "poses.csv"});
  return sources;
}

// What a project folder of this program, COLMAP or ODM holds, the most direct first.
std::vector<Source> sources_in(const fs::path& folder) {
  std::vector<Source> sources;
  for (const fs::path& place : {folder, folder / "0", folder / "sparse" / "0", folder / "sparse", folder / "opensfm"}) {
    const std::vector<Source> here = sources_directly_in(place);
    sources.insert(sources.end(), here.begin(), here.end());
  }
  return sources;
}

// The first characters of the file that say something.
std::string beginning(const fs::path& file) {
  LineReader reader(file.string());
  while (reader.next())
    if (!is_blank_or_comment(reader.line())) return std::string(trimmed(reader.line()).substr(0, 4096));
  return {};
}

// A file by its name where that is fixed, else by its content.
std::optional<Source> source_of_file(const fs::path& file) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  if ((stem == "cameras" || stem == "images" || stem == "points3D") && (extension == ".txt" || extension == ".bin")) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    return Source{Kind::colmap, folder};
  }
  if (extension == ".csv") return Source{Kind::csv, file};
  if (extension == ".json") return Source{Kind::opensfm, file};
  const std::string text = beginning(file);
  if (text.starts_with('[')) return Source{Kind::opensfm, file};
  if (text.find(',') != std::string::npos && text.find("image") != std::string::npos) return Source{Kind::csv, file};
  return std::nullopt;
}

PoseSet read(const Source& source) {
  switch (source.kind) {
    case Kind::csv: return read_poses_csv(source.path.string());
    case Kind::colmap: return colmap::read_model(source.path.string());
    case Kind::opensfm: return read_opensfm(source.path.string());
  }
  return {};
}

PoseSet read_folder(const fs::path& folder) {
  const std::vector<Source> sources = sources_in(folder);
  if (sources.empty()) throw bad_input(folder.string() + ": no poses are in this folder; " + kAccepted);
  PoseSet poses = read(sources.front());
  for (std::size_t i = 1; i < sources.size(); ++i)
    poses.notes.push_back(sources[i].path.string() + ": was not read, because the poses were taken from " +
                          sources.front().path.string() + ".");
  return poses;
}

}  // namespace

PoseSet read_poses(const std::string& path) {
  try {
    if (!fs::exists(path)) throw bad_input(path + ": there is no such file or folder of poses; " + kAccepted);
    if (fs::is_directory(path)) return read_folder(path);
    if (const std::optional<Source> source = source_of_file(path)) return read(*source);
  } catch (const fs::filesystem_error& error) {
    throw bad_input(path + ": cannot be opened (" + error.code().message() + ").");
  }
  throw bad_input(path + ": is no pose file; " + kAccepted);
}

}  // namespace skysweep::formats
