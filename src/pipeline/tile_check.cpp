// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_check.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "pipeline/tile_digest.h"

namespace skysweep::pipeline {
namespace {

using index::ImageRecord;
using index::TileRecord;

std::optional<sweep::HeightRange> heights_of(const TileRecord& row) {
  if (row.z_low == 0 && row.z_high == 0) return std::nullopt;
  return sweep::HeightRange{row.z_low, row.z_high};
}

std::string before_dash(const std::string& digest) { return digest.substr(0, digest.find('-')); }

// What happened to the photographs that a tile was made from, at most a few of them by name.
class Reasons {
 public:
  void add(const std::string& reason) {
    if (++count_ <= kNamed) text_ += (text_.empty() ? "" : ", ") + reason;
  }
  std::string text() const {
    return count_ > kNamed ? text_ + " and " + std::to_string(count_ - kNamed) + " more" : text_;
  }

 private:
  static constexpr int kNamed = 3;
  int count_ = 0;
  std::string text_;
};

std::string why_other_inputs(const TileRecord& row, const TileInputs& inputs,
                             const std::vector<const ImageRecord*>& candidates) {
  std::map<std::string, const ImageRecord*> now;
  for (const ImageRecord* image : candidates) now[image->name] = image;
  Reasons reasons;
  for (std::size_t i = 0; i < row.views.size() && i < row.view_digests.size(); ++i) {
    const auto found = now.find(row.views[i]);
    if (found == now.end()) {
      reasons.add(row.views[i] + " does not show it any more or is gone");
      continue;
    }
    const std::string digest = view_digest(*found->second);
    if (digest == row.view_digests[i]) continue;
    const bool other_bytes = before_dash(digest) != before_dash(row.view_digests[i]);
    reasons.add(row.views[i] + (other_bytes ? " has other bytes" : " has another pose or camera"));
  }
  for (const int i : inputs.chosen.chosen)
    if (std::find(row.views.begin(), row.views.end(), candidates[i]->name) == row.views.end())
      reasons.add(candidates[i]->name + " serves it now");
  for (const std::string& view : row.views) {
    const auto serves = [&](int i) { return candidates[i]->name == view; };
    if (now.contains(view) && std::none_of(inputs.chosen.chosen.begin(), inputs.chosen.chosen.end(), serves))
      reasons.add(view + " serves it no longer");
  }
  const std::string text = reasons.text();
  return text.empty() ? "the settings, or the photographs that its ground is looked for with, are others" : text;
}

double share_with_height(const Array2d<float>& dem) {
  const auto known = std::count_if(dem.begin(), dem.end(), [](float z) { return !std::isnan(z); });
  return static_cast<double>(known) / static_cast<double>(dem.size());
}

}  // namespace

void note_files(const tiles::TileStore& store, tiles::TileKey key, TileRecord& row) {
  row.stamp = store.stamp(key).value_or("");
  row.checksum = row.stamp.empty() ? "" : store.checksum(key);
}

TileChecker::TileChecker(const ProjectSettings& settings, const tiles::TileStore& store, bool read_everything)
    : settings_(settings),
      store_(store),
      read_everything_(read_everything),
      settings_digest_(settings_digest(settings)) {}

bool TileChecker::files_are_as_written(tiles::TileKey key, TileRecord& row) const {
  const std::optional<std::string> stamp = store_.stamp(key);
  if (row.checksum.empty()) return !stamp;
  if (!stamp) return false;
  if (*stamp == row.stamp && !read_everything_) return true;
  try {
    if (store_.checksum(key) != row.checksum) return false;
  } catch (const Error&) {
    return false;
  }
  row.stamp = *stamp;
  return true;
}

TileCheck TileChecker::check(tiles::TileKey key, const Coverage& coverage, const TileRecord* row) const {
  TileCheck check;
  const std::string of_candidates = coverage.candidates_digest(key, settings_digest_);
  bool whole = false;
  if (row) {
    check.row = *row;
    whole = files_are_as_written(key, check.row);
    if (whole && row->candidates_digest == of_candidates) {
      check.fresh = true;
      check.why = "the photographs that may show it are those it was made from";
      return check;
    }
  }
  const std::vector<const ImageRecord*> candidates = coverage.candidates(key);
  if (row) {
    const TileGeometry geometry(key, candidates, settings_);
    const TileInputs inputs(geometry, heights_of(*row));
    const bool same_inputs = inputs.digest(key, geometry, candidates, settings_digest_) == row->input_digest;
    if (whole && same_inputs) {
      check.fresh = true;
      check.row.candidates_digest = of_candidates;
      check.why = "photographs that may show it have changed, but none that serve it";
      return check;
    }
    check.why =
        same_inputs ? "its files are missing or not as they were written" : why_other_inputs(*row, inputs, candidates);
    check.damaged = same_inputs;
  }
  if (std::optional<TileRecord> found = row_from_labels(key, candidates)) {
    const bool torn = row && row->input_digest == found->input_digest;  // but its checksum is another
    if (torn) return check;
    check = {true, "its row in the catalogue was lost; its own labels tell the same inputs", false, std::move(*found)};
    check.row.candidates_digest = of_candidates;
    return check;
  }
  if (!row) check.why = "it has not been computed";
  return check;
}

std::optional<TileRecord> TileChecker::row_from_labels(tiles::TileKey key,
                                                       const std::vector<const ImageRecord*>& candidates) const {
  const std::optional<tiles::TileOrigin> origin = store_.origin(key);
  if (!origin) return std::nullopt;
  TileRecord row;
  std::optional<sweep::HeightRange> heights;
  if (origin->searched) heights = sweep::HeightRange{origin->searched->low, origin->searched->high};
  const TileGeometry geometry(key, candidates, settings_);
  const TileInputs inputs(geometry, heights);
  row.input_digest = inputs.digest(key, geometry, candidates, settings_digest_);
  if (row.input_digest != origin->input_digest) return std::nullopt;
  try {
    const std::optional<tiles::Tile> tile = store_.read(key);
    if (!tile) return std::nullopt;
    row.valid_share = share_with_height(tile->dem);
    note_files(store_, key, row);
  } catch (const Error&) {
    return std::nullopt;
  }
  row.name = key.name();
  row.level = key.level;
  row.extent = settings_.lattice.extent(key);
  if (heights) row.z_low = heights->z_low, row.z_high = heights->z_high;
  for (const int i : inputs.chosen.chosen) {
    row.views.push_back(candidates[i]->name);
    row.view_digests.push_back(view_digest(*candidates[i]));
  }
  return row;
}

}  // namespace skysweep::pipeline
