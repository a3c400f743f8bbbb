// SPDX-License-Identifier: Apache-2.0
#include "pipeline/configuration.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "core/error.h"
#include "settings/preset.h"

namespace skysweep::pipeline {
namespace {

using settings::TomlTable;
using settings::TomlWriter;

// The words that stand for the values of an enumeration, in the order of the values.
template <typename Enum>
constexpr int kWords = 0;
template <>
constexpr std::array<const char*, 3> kWords<sweep::MatchingCost>{"sad", "zncc", "census"};
template <>
constexpr std::array<const char*, 3> kWords<sweep::Aggregation>{"all", "better-half", "consensus"};
template <>
constexpr std::array<const char*, 2> kWords<sweep::Smoothing>{"none", "semi-global"};

template <>
constexpr std::array<const char*, 2> kWords<sweep::Orthophoto>{"best", "mean"};

template <typename Words>
std::string listed(const Words& words) {
  std::string text;
  for (const char* word : words) text += (text.empty() ? "\"" : ", \"") + std::string(word) + "\"";
  return text;
}

// One list of (key, member) serves reading and writing: a setting cannot be read and not written.
class Reader {
 public:
  explicit Reader(const TomlTable& table) : table_(table) {}
  void operator()(const char* key, int& member) { set(member, table_.integer(key)); }
  void operator()(const char* key, double& member) { set(member, table_.number(key)); }
  void operator()(const char* key, bool& member) { set(member, table_.boolean(key)); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* key, Enum& member) {
    const auto text = table_.string(key);
    if (!text) return;
    const auto& words = kWords<Enum>;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found == words.end()) throw usage_error(table_.where(key) + " must be one of " + listed(words) + ".");
    member = static_cast<Enum>(found - words.begin());
  }

 private:
  template <typename T, typename U>
  void set(T& member, const std::optional<U>& value) {
    if (value) member = static_cast<T>(*value);
  }
  const TomlTable& table_;
};

class Writer {
 public:
  explicit Writer(TomlWriter& toml) : toml_(toml) {}
  void operator()(const char* key, int& member) { toml_.integer(key, member); }
  void operator()(const char* key, double& member) { toml_.number(key, member); }
  void operator()(const char* key, bool& member) { toml_.boolean(key, member); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* key, Enum& member) { toml_.string(key, kWords<Enum>[static_cast<std::size_t>(member)]); }

 private:
  TomlWriter& toml_;
};

template <typename Visitor>
void visit(PhotographOptions& o, Visitor&& key) {
  key("near_vertical_limit_deg", o.near_vertical_limit_deg);
}

template <typename Visitor>
void visit(TileOptions& o, Visitor&& key) {
  key("cells", o.cells);
  key("collar_cells", o.collar_cells);
}

template <typename Visitor>
void visit(index::ViewSelectionOptions& o, Visitor&& key) {
  key("views_per_place", o.views_per_place);
  key("max_views", o.max_views);
  key("max_off_nadir_deg", o.max_off_nadir_deg);
  key("min_baseline_ratio", o.min_baseline_ratio);
  key("full_baseline_ratio", o.full_baseline_ratio);
}

template <typename Visitor>
void visit(sweep::SweepOptions& o, Visitor&& key) {
  key("window_level_min", o.window_level_min);
  key("window_level_max", o.window_level_max);
  key("cost", o.cost);
  key("patch_radius_cells", o.patch_radius_cells);
  key("normalization_radius_px", o.normalization_radius_px);
  key("normalization_tolerance", o.normalization_tolerance);
  key("coarse_levels", o.coarse_levels);
  key("rival_tolerance", o.rival_tolerance);
  key("visibility_passes", o.visibility_passes);
  key("sure_excess", o.sure_excess);
  key("follow_slopes", o.follow_slopes);
  key("edge_contrast", o.edge_contrast);
  key("hidden_cost", o.hidden_cost);
  key("aggregation", o.aggregation);
  key("consensus_share", o.consensus_share);
  key("smoothing", o.smoothing);
  key("small_step_penalty", o.small_step_penalty);
  key("large_step_penalty", o.large_step_penalty);
  key("refinement_radius_cells", o.refinement_radius_cells);
  key("volume_limit_mib", o.volume_limit_mib);
  key("min_views", o.min_views);
  key("few_views_penalty", o.few_views_penalty);
  key("max_cost", o.max_cost);
  key("max_cost_to_mean", o.max_cost_to_mean);
  key("speckle_cells", o.speckle_cells);
  key("edge_passes", o.edge_passes);
  key("edge_reach_cells", o.edge_reach_cells);
  key("edge_penalty", o.edge_penalty);
  key("edge_hidden_cost", o.edge_hidden_cost);
  key("fill", o.fill);
  key("close_gap_cells", o.close_gap_cells);
  key("plane_step_px", o.plane_step_px);
  key("orthophoto", o.orthophoto);
  key("seam_cost", o.seam_cost);
  key("compensate_exposure", o.compensate_exposure);
  key("planar_fallback", o.planar_fallback);
}

// Calls f(section name, options) for each section.
template <typename F>
void for_each_section(Configuration& c, F&& f) {
  f("photographs", c.photographs);
  f("tiles", c.tiles);
  f("views", c.views);
  f("sweep", c.sweep);
}

std::optional<std::string> problem(const PhotographOptions& o) {
  if (!(o.near_vertical_limit_deg >= 3 && o.near_vertical_limit_deg <= 80))
    return "near_vertical_limit_deg must lie between 3 and 80";
  return std::nullopt;
}

std::optional<std::string> problem(const TileOptions& o) {
  if (o.cells < 64 || o.cells > 4096 || o.cells % 64 != 0) return "cells must be a multiple of 64 from 64 to 4096";
  if (o.collar_cells < 0 || o.collar_cells > 512) return "collar_cells must lie between 0 and 512";
  return std::nullopt;
}

std::optional<std::string> problem(const index::ViewSelectionOptions& o) {
  if (o.max_views > sweep::kMaxViews) return "max_views must not exceed " + std::to_string(sweep::kMaxViews);
  return o.problem();
}

std::optional<std::string> problem(const sweep::SweepOptions& o) { return o.problem(); }

}  // namespace

Configuration configuration_from(const TomlTable& toml) {
  Configuration configuration;
  for_each_section(configuration, [&](const char* name, auto& options) {
    const std::optional<TomlTable> table = toml.table(name);
    if (!table) return;
    visit(options, Reader(*table));
    if (const auto sentence = problem(options)) throw usage_error(toml.where(name) + ": " + *sentence + ".");
  });
  return configuration;
}

Configuration read_configuration(const std::string& preset, const std::optional<std::filesystem::path>& file) {
  const TomlTable toml = settings::read_settings(preset, file);
  const Configuration configuration = configuration_from(toml);
  toml.refuse_unknown();
  return configuration;
}

void write_configuration(TomlWriter& toml, const Configuration& configuration) {
  Configuration copy = configuration;  // one visitor serves reading and writing
  for_each_section(copy, [&](const char* name, auto& options) {
    toml.section(name);
    visit(options, Writer(toml));
  });
}

std::string configuration_text(const Configuration& configuration) {
  TomlWriter toml;
  write_configuration(toml, configuration);
  return toml.text();
}

}  // namespace skysweep::pipeline
