// SPDX-License-Identifier: Apache-2.0
#include "scene/file/read_products.h"

#include <chrono>
#include <cstdio>

#include "scene/file/read_values.h"

namespace skysweep::scene {
namespace {

// "2026-06-21T10:00:00", UTC.
std::chrono::sys_seconds read_time(const TomlTable& table, const std::string& key, const std::string& text) {
  int year = 0;
  unsigned month = 0, day = 0, hour = 0, minute = 0, second = 0;
  char after = 0;
  const int found =
      std::sscanf(text.c_str(), "%4d-%2u-%2uT%2u:%2u:%2u%c", &year, &month, &day, &hour, &minute, &second, &after);
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{month}, std::chrono::day{day}};
  if (found != 6 || !date.ok() || year < 1970 || hour > 23 || minute > 59 || second > 59)
    throw usage_error(table.where(key) + " must be a time such as \"2026-06-21T10:00:00\" (UTC), not \"" + text + "\"");
  return std::chrono::sys_days{date} + std::chrono::hours(hour) + std::chrono::minutes(minute) +
         std::chrono::seconds(second);
}

Metadata read_metadata(const TomlTable& table) {
  Metadata out;
  out.make = table.string("make").value_or(out.make);
  out.model = table.string("model").value_or(out.model);
  read(table, "sensor_width_mm", out.sensor_width_mm, kTiny);
  if (const auto start = table.string("start")) out.start = read_time(table, "start", *start);
  read(table, "speed_mps", out.speed_mps, kTiny);
  return out;
}

}  // namespace

PhotoFormat read_photo_format(const TomlTable& table, const std::string& format) {
  for (const PhotoFormat known : {PhotoFormat::jpeg, PhotoFormat::png, PhotoFormat::tiff, PhotoFormat::exr})
    if (format == file_ending(known)) return known;
  throw usage_error(table.where("format") + " must be \"jpg\", \"png\", \"tif\" or \"exr\", not \"" + format + "\"");
}

void read_products(const TomlTable& scene, Scene& out) {
  if (const auto table = scene.table("metadata")) out.metadata = read_metadata(*table);
  if (const auto table = scene.table("truth")) {
    read(*table, "cell_m", out.truth.cell_m, kTiny);
    read(*table, "tie_points", out.truth.tie_points, 0, 1000000);
    out.truth.depth = table->boolean("depth").value_or(false);
  }
  if (const auto table = scene.table("ground_control")) {
    out.ground_control.emplace();
    read(*table, "points", out.ground_control->points, 1, 10000);
  }
}

}  // namespace skysweep::scene
