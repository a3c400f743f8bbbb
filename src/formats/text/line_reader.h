// SPDX-License-Identifier: Apache-2.0
// A text file line by line, whoever wrote it: with or without byte order mark, Unix or Windows line ends.
#pragma once

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace skysweep::formats {

class LineReader {
 public:
  // Throws Error(bad_input) if the file cannot be opened.
  explicit LineReader(const std::string& path);

  // Whether there was another line; it is in line() then, without its end.
  bool next();

  const std::string& line() const { return line_; }
  // Whether a line break followed; false only for the last line of a file that ends without one.
  bool line_is_ended() const { return !file_.eof(); }
  int line_number() const { return line_number_; }
  // "path:line", which begins every message about the current line.
  std::string where() const;

 private:
  std::string path_;
  std::ifstream file_;
  std::string line_;
  int line_number_ = 0;
};

// `text` without white space at both ends.
std::string_view trimmed(std::string_view text);

// Whether the line says nothing: blank, or a comment (#).
bool is_blank_or_comment(std::string_view line);

// The words of a line, separated by white space.
std::vector<std::string_view> words(std::string_view line);

}  // namespace skysweep::formats
