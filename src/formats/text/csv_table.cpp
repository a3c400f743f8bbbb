// SPDX-License-Identifier: Apache-2.0
#include "formats/text/csv_table.h"

#include <algorithm>

#include "core/check.h"
#include "core/error.h"
#include "formats/text/line_reader.h"
#include "formats/text/numbers.h"

namespace skysweep::formats {
namespace {

constexpr int kLargestSize = 1'000'000;  // pixels along one side; beyond it the column holds something else

// The fields of one line; `where` is for messages.
std::vector<std::string> split_fields(std::string_view line, const std::string& where) {
  std::vector<std::string> fields;
  std::size_t at = 0;
  for (;;) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t", at), line.size());
    if (begin < line.size() && line[begin] == '"') {
      std::string field;
      for (at = begin + 1;; ++at) {
        if (at >= line.size())
          throw bad_input(where + ": a double quote is opened and not closed on the same line; close it.");
        if (line[at] != '"') {
          field += line[at];
        } else if (at + 1 < line.size() && line[at + 1] == '"') {
          field += line[at++];
        } else {
          break;
        }
      }
      at = std::min(line.find_first_not_of(" \t", at + 1), line.size());
      if (at < line.size() && line[at] != ',')
        throw bad_input(where + ": text follows a closing double quote; write a quote inside a field twice.");
      fields.push_back(std::move(field));
    } else {
      at = std::min(line.find(',', begin), line.size());
      fields.emplace_back(trimmed(line.substr(begin, at - begin)));
    }
    if (at >= line.size()) return fields;
    ++at;  // the comma
  }
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

std::optional<std::size_t> CsvTable::index_of(std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

bool CsvTable::has_all(const std::vector<std::string_view>& names) const { return missing(names).empty(); }

std::vector<std::string_view> CsvTable::missing(const std::vector<std::string_view>& names) const {
  std::vector<std::string_view> absent;
  for (const std::string_view name : names)
    if (!has(name)) absent.push_back(name);
  return absent;
}

void CsvTable::require_unique(const std::vector<std::string_view>& names) const {
  for (const std::string_view name : names)
    if (std::count(columns.begin(), columns.end(), name) > 1)
      throw bad_input(where() + ": the header names column '" + std::string(name) + "' more than once; keep one.");
}

CsvTable read_csv(const std::string& path) {
  CsvTable table;
  table.path = path;
  LineReader reader(path);
  while (reader.next()) {
    if (is_blank_or_comment(reader.line())) continue;
    std::vector<std::string> fields = split_fields(reader.line(), reader.where());
    if (table.header_line != 0) {
      table.rows.push_back({reader.line_number(), std::move(fields)});
      continue;
    }
    if (fields.size() == 1 && fields[0].find_first_of(";\t") != std::string::npos)
      throw bad_input(reader.where() + ": the columns are not separated by commas; write the file with commas.");
    table.header_line = reader.line_number();
    for (std::string& field : fields) table.columns.push_back(lower_case(std::move(field)));
  }
  if (table.header_line == 0) throw bad_input(path + ": is empty; a header row with the column names is expected.");
  return table;
}

void CsvRecord::require_complete() const {
  if (row_.fields.size() != table_.columns.size())
    throw bad_input(where() + ": has " + std::to_string(row_.fields.size()) + " fields where the header has " +
                    std::to_string(table_.columns.size()) + "; put names with commas in double quotes.");
}

const std::string& CsvRecord::text(std::string_view column) const {
  const std::optional<std::size_t> index = table_.index_of(column);
  SKY_CHECK(index.has_value());
  SKY_CHECK_LT(*index, row_.fields.size());
  return row_.fields[*index];
}

double CsvRecord::number(std::string_view column) const {
  const std::string& field = text(column);
  if (const std::optional<double> value = parse_number(field)) return *value;
  throw bad_input(where() + ": column '" + std::string(column) + "' holds '" + field +
                  "', which is not a finite number.");
}

double CsvRecord::number_or(std::string_view column, double otherwise) const {
  return table_.has(column) ? number(column) : otherwise;
}

int CsvRecord::size(std::string_view column) const {
  const double value = number(column);
  if (value >= 1 && value <= kLargestSize && value == static_cast<int>(value)) return static_cast<int>(value);
  throw bad_input(where() + ": column '" + std::string(column) + "' holds '" + text(column) +
                  "', which is not a positive whole number of pixels.");
}

std::string enumeration(const std::vector<std::string_view>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text.append("'").append(names[i]).append("'");
  }
  return text;
}

}  // namespace skysweep::formats
