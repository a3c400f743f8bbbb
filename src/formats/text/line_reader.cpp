// SPDX-License-Identifier: Apache-2.0
#include "formats/text/line_reader.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace skysweep::formats {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n\f\v";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

LineReader::LineReader(const std::string& path) : path_(path) {
  if (std::filesystem::is_directory(path)) throw bad_input(path + ": is a folder where a file is expected.");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_) throw bad_input(path + ": cannot be opened (" + std::strerror(errno) + ").");
}

bool LineReader::next() {
  if (!std::getline(file_, line_)) {
    if (file_.bad()) throw bad_input(where() + ": the file cannot be read further; check the disk it lies on.");
    return false;
  }
  if (++line_number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
  if (line_.ends_with('\r')) line_.pop_back();
  return true;
}

std::string LineReader::where() const { return path_ + ":" + std::to_string(line_number_); }

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kWhiteSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhiteSpace) - begin + 1);
}

bool is_blank_or_comment(std::string_view line) {
  const std::string_view content = trimmed(line);
  return content.empty() || content.front() == '#';
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(kWhiteSpace, end);
    if (begin == std::string_view::npos) return found;
    end = std::min(line.find_first_of(kWhiteSpace, begin), line.size());
    found.push_back(line.substr(begin, end - begin));
  }
}

}  // namespace skysweep::formats
