// SPDX-License-Identifier: Apache-2.0
#include "watch/status.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace skysweep::watch {
namespace {

void metric(std::string& text, const char* name, const char* type, const char* help,
            const std::vector<std::pair<std::string, double>>& samples) {
  text += std::string("# HELP ") + name + " " + help + "\n# TYPE " + name + " " + type + "\n";
  for (const auto& [labels, value] : samples) {
    char number[40];
    std::snprintf(number, sizeof number, "%.10g", value);
    text += name + labels + " " + number + "\n";
  }
}

std::string state_label(const char* state) { return std::string("{state=\"") + state + "\"}"; }

std::string label_value(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\' || c == '"') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

std::string status_line(const Status& s) {
  std::string line = s.state;
  if (!s.stage.empty())
    line += ", " + s.stage + " " + std::to_string(s.stage_done) + "/" + std::to_string(s.stage_total);
  line += ": " + std::to_string(s.mapped) + " of " + std::to_string(s.photographs) + " photographs in " +
          std::to_string(s.groups.size()) + (s.groups.size() == 1 ? " map, " : " maps, ") + std::to_string(s.due) +
          " due, " + std::to_string(s.waiting_for_pose) + " without pose, " + std::to_string(s.poses_waiting) +
          " poses without photograph, " + std::to_string(s.arriving) + " arriving, " + std::to_string(s.quarantined) +
          " in quarantine";
  return line;
}

std::string status_json(const Status& s, double updated) {
  nlohmann::json groups = nlohmann::json::array();
  for (const GroupStatus& group : s.groups) {
    nlohmann::json entry{{"name", group.name},
                         {"photographs", group.photographs},
                         {"tiles_computed", group.tiles_computed},
                         {"state", group.state}};
    if (!group.reason.empty()) entry["reason"] = group.reason;
    groups.push_back(std::move(entry));
  }
  nlohmann::json json{{"updated", static_cast<long long>(updated)},
                      {"state", s.state},
                      {"looks_by", s.looks_by},
                      {"photographs", s.photographs},
                      {"arriving", s.arriving},
                      {"waiting_for_pose", s.waiting_for_pose},
                      {"poses_waiting", s.poses_waiting},
                      {"due", s.due},
                      {"mapped", s.mapped},
                      {"quarantined", s.quarantined},
                      {"batches", s.batches},
                      {"troubles", s.troubles},
                      {"groups", std::move(groups)}};
  if (!s.stage.empty()) json["stage"] = {{"name", s.stage}, {"done", s.stage_done}, {"total", s.stage_total}};
  if (s.median_seconds_to_tiles) json["median_seconds_to_tiles"] = *s.median_seconds_to_tiles;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string prometheus_text(const Status& s) {
  std::string text;
  metric(text, "skysweep_watch_photographs", "gauge", "Photographs by what has become of them.",
         {{state_label("mapped"), s.mapped},
          {state_label("due"), s.due},
          {state_label("waiting_for_pose"), s.waiting_for_pose},
          {state_label("quarantined"), s.quarantined}});
  metric(text, "skysweep_watch_files_arriving", "gauge", "Files that are not complete yet.", {{"", s.arriving}});
  metric(text, "skysweep_watch_poses_waiting", "gauge", "Poses whose photograph has not come.",
         {{"", s.poses_waiting}});
  metric(text, "skysweep_watch_batches_total", "counter", "Times a map was brought up to date.",
         {{"", static_cast<double>(s.batches)}});
  metric(text, "skysweep_watch_mapping", "gauge", "1 while a batch is in work.", {{"", s.stage.empty() ? 0.0 : 1.0}});
  metric(text, "skysweep_watch_troubles", "gauge", "Things that need somebody; status.json names them.",
         {{"", static_cast<double>(s.troubles.size())}});
  if (s.median_seconds_to_tiles)
    metric(text, "skysweep_watch_median_seconds_to_tiles", "gauge",
           "Median time from a complete photograph with its pose to its tiles on disk.",
           {{"", *s.median_seconds_to_tiles}});
  std::vector<std::pair<std::string, double>> tiles;
  for (const GroupStatus& group : s.groups)
    tiles.emplace_back("{group=\"" + label_value(group.name) + "\"}", static_cast<double>(group.tiles_computed));
  if (!tiles.empty()) metric(text, "skysweep_watch_tiles_total", "counter", "Tiles computed.", tiles);
  return text;
}

}  // namespace skysweep::watch
