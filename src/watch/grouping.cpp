// SPDX-License-Identifier: Apache-2.0
#include "watch/grouping.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>

#include "raster/digest.h"
#include "watch/quarantine.h"

namespace skysweep::watch {
namespace {

constexpr const char* kOnlyGroup = "map";
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kDigestDigits = 8;
// Files of the root folder, which no group may be called.
const std::set<std::string> kTaken = {"groups.csv", "quarantine.csv", "status.json"};

bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.' || (static_cast<unsigned char>(c) & 0x80) != 0;
}

// "2026-11-23T071500", the time of the first photograph.
std::string name_of_time(double time_s) {
  const std::chrono::sys_seconds time{std::chrono::seconds(static_cast<long long>(std::floor(time_s)))};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d%02d%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()));
  return text;
}

// A folder that is called as the group of the photographs beside it is another one.
std::string name_of_folder(const std::string& folder) {
  return safe_name(folder == kOnlyGroup ? folder + "/" : folder);
}

std::string name_of_place(Vec3d center) {
  return "x" + std::to_string(std::llround(center.x)) + "y" + std::to_string(std::llround(center.y));
}

}  // namespace

std::string safe_name(const std::string& name) {
  std::string safe;
  for (const char c : name) safe += is_safe(c) ? c : '_';
  if (safe.empty() || safe.front() == '.') safe.insert(0, "_");
  if (safe.size() > kLongestName) safe.resize(kLongestName - kDigestDigits - 1);
  if (kTaken.contains(safe)) safe += "_";
  return safe == name ? safe : safe + "-" + raster::digest_of_bytes(name).substr(0, kDigestDigits);
}

std::optional<GroupRule> group_rule_named(const std::string& name) {
  if (name == "none") return GroupRule::none;
  if (name == "folder") return GroupRule::folder;
  if (name == "time") return GroupRule::time;
  if (name == "distance") return GroupRule::distance;
  return std::nullopt;
}

void Grouping::use(GroupRule rule, double gap) {
  if (rule == rule_ && gap == gap_) return;
  // The cells are as wide as the gap.
  const auto placed = std::exchange(places_, {});
  rule_ = rule;
  gap_ = gap;
  for (const auto& [cell, photographs] : placed)
    for (const auto& photograph : photographs) places_[cell_of(photograph.first)].push_back(photograph);
}

void Grouping::restore(const std::string& text) {
  for (const std::vector<std::string>& row : csv_rows(text)) {
    if (row.size() != 2 || row[0].empty() || row[1].empty() || row == std::vector<std::string>{"photograph", "group"})
      continue;
    if (safe_name(row[1]) != row[1]) continue;  // edited into something that would leave the root folder
    const auto found = std::find(names_.begin(), names_.end(), row[1]);
    group_of_[row[0]] = found == names_.end() ? make_group(row[1]) : static_cast<int>(found - names_.begin());
  }
}

std::string Grouping::text() const {
  std::vector<std::pair<int, std::string>> rows;
  for (const auto& [photograph, group] : group_of_) rows.emplace_back(root_of(group), photograph);
  std::sort(rows.begin(), rows.end());
  std::string text = "photograph,group\n";
  for (const auto& [group, photograph] : rows) text += csv_field(photograph) + "," + csv_field(names_[group]) + "\n";
  return text;
}

int Grouping::root_of(int group) const {
  while (parent_[group] != group) group = parent_[group];
  return group;
}

int Grouping::make_group(const std::string& name) {
  names_.push_back(name);
  parent_.push_back(static_cast<int>(parent_.size()));
  return parent_.back();
}

// The oldest of them, which the others become part of.
int Grouping::join(const std::vector<int>& groups) {
  int oldest = root_of(groups.front());
  for (const int group : groups) oldest = std::min(oldest, root_of(group));
  for (const int group : groups) parent_[root_of(group)] = oldest;
  return oldest;
}

std::vector<int> Grouping::near_in_time(double time_s) const {
  std::vector<int> near;
  const double gap_s = 60 * gap_;
  const auto above = times_.lower_bound(time_s);
  if (above != times_.end() && above->first - time_s <= gap_s) near.push_back(above->second);
  if (above != times_.begin() && time_s - std::prev(above)->first <= gap_s) near.push_back(std::prev(above)->second);
  return near;
}

Grouping::Cell Grouping::cell_of(Vec2d place) const {
  return {std::llround(std::floor(place.x / gap_)), std::llround(std::floor(place.y / gap_))};
}

std::vector<int> Grouping::near_on_ground(Vec2d place) const {
  std::vector<int> near;
  const Cell middle = cell_of(place);
  for (long long y = middle.second - 1; y <= middle.second + 1; ++y)
    for (long long x = middle.first - 1; x <= middle.first + 1; ++x) {
      const auto cell = places_.find({x, y});
      if (cell == places_.end()) continue;
      for (const auto& [other, group] : cell->second)
        if (norm(other - place) <= gap_) near.push_back(group);
    }
  return near;
}

std::string Grouping::new_name(const Photograph& photograph) const {
  std::string name = kOnlyGroup;
  if (rule_ == GroupRule::time) name = name_of_time(*photograph.time_s);
  if (rule_ == GroupRule::distance) name = name_of_place(photograph.center);
  std::string unique = name;
  for (int n = 2; std::find(names_.begin(), names_.end(), unique) != names_.end(); ++n)
    unique = name + "-" + std::to_string(n);
  return unique;
}

std::optional<std::string> Grouping::place(const Photograph& photograph) {
  if (rule_ == GroupRule::time && !photograph.time_s) return std::nullopt;
  const auto known = group_of_.find(photograph.name);
  if (known != group_of_.end() && seen_[photograph.name]) return group_of(photograph.name);
  seen_[photograph.name] = true;
  const Vec2d place{photograph.center.x, photograph.center.y};
  std::vector<int> candidates;
  if (known != group_of_.end()) candidates.push_back(known->second);
  if (rule_ == GroupRule::none || rule_ == GroupRule::folder) {
    if (candidates.empty()) {
      const std::string folder = std::filesystem::path(photograph.name).parent_path().generic_string();
      const std::string name = rule_ == GroupRule::none || folder.empty() ? kOnlyGroup : name_of_folder(folder);
      const auto found = std::find(names_.begin(), names_.end(), name);
      candidates.push_back(found == names_.end() ? make_group(name) : static_cast<int>(found - names_.begin()));
    }
  } else {
    const std::vector<int> near = rule_ == GroupRule::time ? near_in_time(*photograph.time_s) : near_on_ground(place);
    candidates.insert(candidates.end(), near.begin(), near.end());
    if (candidates.empty()) candidates.push_back(make_group(new_name(photograph)));
  }
  const int group = join(candidates);
  group_of_[photograph.name] = group;
  if (photograph.time_s) times_.emplace(*photograph.time_s, group);
  places_[cell_of(place)].emplace_back(place, group);
  return names_[group];
}

std::string Grouping::group_of(const std::string& photograph) const {
  return names_[root_of(group_of_.at(photograph))];
}

}  // namespace skysweep::watch
