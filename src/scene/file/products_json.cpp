// SPDX-License-Identifier: Apache-2.0
#include "scene/file/products_json.h"

#include <chrono>
#include <cstdio>

namespace skysweep::scene {
namespace {

std::string utc_text(std::chrono::sys_seconds time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()));
  return text;
}

}  // namespace

// What a scene may leave out stands in the file only where the scene names it.
void add_products_json(const Scene& scene, nlohmann::ordered_json& out) {
  if (scene.metadata) {
    const Metadata& m = *scene.metadata;
    out["metadata"] = {{"make", m.make},
                       {"model", m.model},
                       {"sensor_width_mm", m.sensor_width_mm},
                       {"start", utc_text(m.start)},
                       {"speed_mps", m.speed_mps}};
  }
  out["truth"] = {{"cell_m", scene.truth_cell_m()}};
  if (scene.truth.tie_points != Truth{}.tie_points) out["truth"]["tie_points"] = scene.truth.tie_points;
  if (scene.truth.depth) out["truth"]["depth"] = true;
  if (scene.ground_control) out["ground_control"] = {{"points", scene.ground_control->points}};
}

}  // namespace skysweep::scene
