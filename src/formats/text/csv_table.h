// SPDX-License-Identifier: Apache-2.0
// A table of comma-separated values with a header row. Blank lines and lines that begin with # are skipped, white space
// around fields too; a field may stand in double quotes ("" is a quote inside). Column names ignore case.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skysweep::formats {

struct CsvTable {
  struct Row {
    int line = 0;
    std::vector<std::string> fields;
  };

  std::string path;
  int header_line = 0;
  std::vector<std::string> columns;  // lower case; may hold names twice
  std::vector<Row> rows;

  std::optional<std::size_t> index_of(std::string_view column) const;
  bool has(std::string_view column) const { return index_of(column).has_value(); }
  bool has_all(const std::vector<std::string_view>& names) const;
  // Those of `names` which are no columns.
  std::vector<std::string_view> missing(const std::vector<std::string_view>& names) const;
  // Throws Error(bad_input) if one of `names` stands in the header more than once.
  void require_unique(const std::vector<std::string_view>& names) const;
  // "path:line" of the header, and of a row.
  std::string where() const { return path + ":" + std::to_string(header_line); }
  std::string where(const Row& row) const { return path + ":" + std::to_string(row.line); }
};

// Throws Error(bad_input), with file and line, if there is no header, a quote stays open or another separator is used.
CsvTable read_csv(const std::string& path);

// One row with its columns by name. Each reading function throws Error(bad_input) with file, line and column.
class CsvRecord {
 public:
  CsvRecord(const CsvTable& table, const CsvTable::Row& row) : table_(table), row_(row) {}

  // Throws if the row has not as many fields as the header.
  void require_complete() const;
  const std::string& text(std::string_view column) const;
  double number(std::string_view column) const;
  double number_or(std::string_view column, double otherwise) const;
  // A positive whole number, such as an image size.
  int size(std::string_view column) const;
  std::string where() const { return table_.where(row_); }

 private:
  const CsvTable& table_;
  const CsvTable::Row& row_;
};

// `names` as an enumeration for a sentence: "'a', 'b' and 'c'".
std::string enumeration(const std::vector<std::string_view>& names);

}  // namespace skysweep::formats
