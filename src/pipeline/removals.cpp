// SPDX-License-Identifier: Apache-2.0
#include "pipeline/removals.h"

#include <fnmatch.h>

#include <algorithm>

#include "core/error.h"
#include "raster/atomic_file.h"

namespace skysweep::pipeline {
namespace {

bool matches(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

template <typename Names>
std::vector<std::string> matching(const std::string& pattern, const Names& names) {
  std::vector<std::string> found;
  std::copy_if(names.begin(), names.end(), std::back_inserter(found),
               [&](const std::string& name) { return matches(pattern, name); });
  return found;
}

}  // namespace

std::set<std::string> read_removals(const ProjectPaths& paths) {
  std::error_code error;
  if (!std::filesystem::exists(paths.removals(), error)) return {};
  const settings::TomlTable toml = settings::TomlTable::read_file(paths.removals());
  const auto names = toml.strings("photographs");
  if (!names) throw bad_input(toml.where("photographs") + " is missing: which photographs are removed?");
  toml.refuse_unknown();
  return {names->begin(), names->end()};
}

void write_removals(const ProjectPaths& paths, const std::set<std::string>& names) {
  settings::TomlWriter toml;
  toml.comment("Photographs that `run --remove` took out of this project; `run --restore` takes them back.");
  toml.strings("photographs", {names.begin(), names.end()});
  raster::write_bytes_atomically(paths.removals(), toml.text());
}

std::set<std::string> changed_removals(std::set<std::string> removed,
                                       const std::vector<index::ImageRecord>& photographs,
                                       const std::vector<std::string>& remove,
                                       const std::vector<std::string>& restore) {
  std::vector<std::string> names;
  for (const index::ImageRecord& photograph : photographs) names.push_back(photograph.name);
  for (const std::string& pattern : restore) {
    const std::vector<std::string> found = matching(pattern, removed);
    if (found.empty()) throw usage_error("--restore " + pattern + " matches no photograph that was removed.");
    for (const std::string& name : found) removed.erase(name);
  }
  for (const std::string& pattern : remove) {
    const std::vector<std::string> found = matching(pattern, names);
    if (found.empty())
      throw usage_error(
          "--remove " + pattern +
          " matches no photograph: names are relative to the image folder, e.g. 'flight2/*' or 'DJI_00??.JPG'.");
    removed.insert(found.begin(), found.end());
  }
  return removed;
}

void mark_removed(std::vector<index::ImageRecord>& records, const std::set<std::string>& removed) {
  if (removed.empty()) return;
  int used = 0;
  for (index::ImageRecord& record : records) {
    if (removed.contains(record.name)) {
      record.status = index::ImageStatus::removed;
      record.reason = "taken out with --remove; --restore takes it back.";
    }
    used += record.status == index::ImageStatus::used;
  }
  if (used < 2)
    throw usage_error("With what --remove took out, " + std::to_string(used) +
                      " photographs are left, and heights need two: take some back with --restore.");
}

}  // namespace skysweep::pipeline
