// SPDX-License-Identifier: Apache-2.0
#include "watch/quarantine.h"

#include <utility>

namespace skysweep::watch {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row{""};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      const bool is_pair = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (is_pair) ++i;
      if (c != '"' || is_pair)
        row.back() += c;
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      row.emplace_back();
    } else if (c == '\n') {
      rows.push_back(std::exchange(row, {""}));
    } else if (c != '\r') {
      row.back() += c;
    }
  }
  if (row.size() > 1 || !row.front().empty()) rows.push_back(row);
  return rows;
}

std::string quarantine_text(const std::map<std::string, std::string>& reasons) {
  std::string text = "file,reason\n";
  for (const auto& [file, reason] : reasons) text += csv_field(file) + "," + csv_field(reason) + "\n";
  return text;
}

}  // namespace skysweep::watch
