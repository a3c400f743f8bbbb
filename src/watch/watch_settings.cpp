// SPDX-License-Identifier: Apache-2.0
#include "watch/watch_settings.h"

#include "core/error.h"
#include "settings/toml_table.h"

namespace skysweep::watch {
namespace {

constexpr double kGapMinutes = 10, kGapMetres = 200;
constexpr double kShortestPoll_s = 0.05;
constexpr std::size_t kMebibyte = std::size_t{1} << 20;

}  // namespace

double WatchSettings::gap() const { return group_gap.value_or(group == GroupRule::time ? kGapMinutes : kGapMetres); }

std::optional<std::string> WatchSettings::problem() const {
  if (group_gap && !(*group_gap > 0)) return "the gap between groups must be a positive number of minutes or metres";
  if (group_gap && group != GroupRule::time && group != GroupRule::distance)
    return "a gap between groups has no effect unless photographs are grouped by time or distance";
  if (first < 2) return "a project cannot be made from fewer than 2 photographs";
  if (poll_s && !(*poll_s >= kShortestPoll_s)) return "polling takes 0.05 seconds or more";
  if (threads && *threads < 1) return "the number of threads must be positive";
  if (memory_bytes && *memory_bytes == 0) return "the memory must be positive";
  return std::nullopt;
}

WatchSettings with_file(WatchSettings base, const std::filesystem::path& file) {
  const settings::TomlTable toml = settings::TomlTable::read_file(file);
  if (const auto watch = toml.table("watch")) {
    if (const auto name = watch->string("group")) {
      const auto rule = group_rule_named(*name);
      if (!rule) throw usage_error(watch->where("group") + " must be none, folder, time or distance.");
      base.group = *rule;
    }
    if (const auto gap = watch->number("group_gap")) base.group_gap = *gap;
    if (const auto first = watch->integer("first")) base.first = static_cast<int>(*first);
    if (const auto poll = watch->number("poll_seconds")) base.poll_s = *poll;
    if (const auto threads = watch->integer("threads")) base.threads = static_cast<int>(*threads);
    if (const auto memory = watch->integer("memory_mib")) {
      if (*memory <= 0) throw usage_error(watch->where("memory_mib") + " must be positive.");
      base.memory_bytes = static_cast<std::size_t>(*memory) * kMebibyte;
    }
  }
  toml.refuse_unknown();
  if (const auto problem = base.problem()) throw usage_error(file.string() + ": " + *problem + ".");
  return base;
}

}  // namespace skysweep::watch
