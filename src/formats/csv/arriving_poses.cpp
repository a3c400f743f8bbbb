// SPDX-License-Identifier: Apache-2.0
#include "formats/arriving_poses.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "formats/csv/poses_table.h"
#include "formats/text/line_reader.h"

namespace skysweep::formats {
namespace {

namespace fs = std::filesystem;

// The cell of a table that says the same as a JSON value; numbers to the last bit.
std::string cell_of(const nlohmann::json& value, const std::string& where, const std::string& key) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  throw bad_input(where + ": the value of '" + key + "' is neither a number nor a text.");
}

CsvTable table_of_json(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw bad_input(path + ": cannot be opened.");
  const nlohmann::json object = nlohmann::json::parse(file, nullptr, false);
  if (!object.is_object())
    throw bad_input(path + ": is no JSON object with the columns of a poses.csv as keys (or not yet whole).");
  CsvTable table;
  table.path = path;
  table.header_line = 1;
  table.rows.push_back({1, {}});
  for (const auto& [key, value] : object.items()) {
    table.columns.push_back(key);
    table.rows.front().fields.push_back(cell_of(value, path, key));
  }
  return table;
}

// Makes the table speak of `photo`.
void name_the_photograph(CsvTable& table, const std::string& photo) {
  CsvTable::Row& row = table.rows.front();
  const auto column = table.index_of("image");
  if (!column) {
    table.columns.emplace_back("image");
    row.fields.push_back(photo);
    return;
  }
  if (*column >= row.fields.size()) return;  // a row that is too short says so itself
  const std::string named = fs::path(row.fields[*column]).filename().string();
  if (const std::string file = fs::path(photo).filename().string(); named != file)
    throw bad_input(table.where(row) + ": names the image '" + row.fields[*column] + "', but lies beside '" + file +
                    "'.");
  row.fields[*column] = photo;
}

bool ends_with_a_whole_line(const CsvTable& table, bool last_line_is_whole, int last_line) {
  return last_line_is_whole || table.rows.empty() || table.rows.back().line != last_line;
}

}  // namespace

PoseSet read_growing_poses(const std::string& path) {
  int last_line = 0;
  bool is_whole = true;
  for (LineReader reader(path); reader.next();) {
    last_line = reader.line_number();
    is_whole = reader.line_is_ended();
  }
  if (last_line == 0 || (last_line == 1 && !is_whole)) return {};
  CsvTable table = read_csv(path);
  if (!ends_with_a_whole_line(table, is_whole, last_line)) table.rows.pop_back();
  if (table.rows.empty()) return {};
  return poses_of_table(table);
}

PosedImage read_pose_sidecar(const std::string& path, const std::string& photo) {
  CsvTable table = fs::path(path).extension() == ".json" ? table_of_json(path) : read_csv(path);
  if (table.rows.size() != 1)
    throw bad_input(path + ": holds " + std::to_string(table.rows.size()) +
                    " lines below its header; a file beside a photograph holds one.");
  name_the_photograph(table, photo);
  PoseSet poses = poses_of_table(table);
  return std::move(poses.images.front());
}

}  // namespace skysweep::formats
