// SPDX-License-Identifier: Apache-2.0
#include "index/view_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "core/check.h"
#include "index/selection/sightings.h"
#include "index/selection/tally.h"

namespace skysweep::index {
namespace {

// Positions of the candidates, by name.
std::vector<int> order_by_name(const std::vector<ViewCandidate>& candidates) {
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return candidates[a].name < candidates[b].name; });
  for (std::size_t i = 1; i < order.size(); ++i) SKY_CHECK(candidates[order[i - 1]].name != candidates[order[i]].name);
  return order;
}

// The view that adds most, the first of equals; nothing if none adds anything. A chosen view adds nothing: its rays
// coincide with themselves.
std::optional<int> best_addition(const std::vector<TileView>& views, const Tally& tally, Points points) {
  std::optional<int> best;
  double best_gain = 0;
  for (int v = 0; v < static_cast<int>(views.size()); ++v)
    if (const double gain = tally.gain(views[v], points); gain > best_gain) best = v, best_gain = gain;
  return best;
}

struct Choice {
  std::vector<int> views;  // first chosen first
  Tally tally;             // with all of them added
};

// As long as some point is shown by too few and a view can help; only such points count.
Choice choose(const std::vector<TileView>& views, const ViewSelectionOptions& options) {
  Choice choice{{}, Tally(options)};
  while (static_cast<int>(choice.views.size()) < options.max_views) {
    const std::optional<int> next = best_addition(views, choice.tally, Points::in_need);
    if (!next) break;
    choice.tally.add(views[*next]);
    choice.views.push_back(*next);
  }
  return choice;
}

std::string rounded(double value) { return std::to_string(std::lround(value)); }

// To three digits: 40.2 stays apart from a limit of 40.
std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// Why a photograph that would add nothing next to the chosen ones was left out.
std::string reason_of_nearness(const ViewCandidate& candidate, const std::vector<const ViewCandidate*>& chosen,
                               const ViewVerdict& verdict, const ViewSelectionOptions& options) {
  const auto distance = [&](const ViewCandidate* other) {
    return norm(other->camera.pose().center - candidate.camera.pose().center);
  };
  const ViewCandidate* nearest = *std::min_element(
      chosen.begin(), chosen.end(), [&](const auto* a, const auto* b) { return distance(a) < distance(b); });
  constexpr double kSamePositionRatio = 0.01;
  const double depth_m = verdict.gsd_m * candidate.camera.model().focal_px();
  if (distance(nearest) < kSamePositionRatio * depth_m) return "same position as " + nearest->name;
  return "sees the tile from the same side as " + nearest->name + ", " + rounded(distance(nearest)) +
         " m away: a baseline below " + rounded(100 * options.min_baseline_ratio) + " % of the depth";
}

std::string reason_of(const ViewVerdict& verdict, const TileView& view, const Choice& choice,
                      const ViewCandidate& candidate, const std::vector<const ViewCandidate*>& chosen,
                      const ViewSelectionOptions& options) {
  const std::string share = rounded(100 * verdict.coverage) + " % of the tile";
  if (view.coverage == 0) return "does not show the tile";
  if (view.smallest_off_nadir_deg >= options.max_off_nadir_deg)
    return degrees(view.smallest_off_nadir_deg) + " degrees from nadir, more than " +
           degrees(options.max_off_nadir_deg);
  if (verdict.chosen) return "shows " + share + ", " + degrees(verdict.off_nadir_deg) + " degrees from nadir";
  if (choice.tally.gain(view, Points::all) == 0) return reason_of_nearness(candidate, chosen, verdict, options);
  const std::string others = std::to_string(chosen.size()) + " better views";
  constexpr double kSmallShare = 0.5;
  if (verdict.coverage < kSmallShare) return "shows " + share + " only; " + others + " show more or from other sides";
  return others + " serve all parts of the tile";
}

}  // namespace

std::optional<std::string> ViewSelectionOptions::problem() const {
  if (views_per_place < 2) return "views_per_place must be at least 2: heights come from pairs of photographs";
  if (max_views < views_per_place) return "max_views must not be less than views_per_place";
  if (!(max_off_nadir_deg > 0 && max_off_nadir_deg <= 90))
    return "max_off_nadir_deg must be more than 0 and at most 90";
  if (!(min_baseline_ratio >= 0)) return "min_baseline_ratio must be 0 or more";
  if (!(full_baseline_ratio > min_baseline_ratio)) return "full_baseline_ratio must be more than min_baseline_ratio";
  return std::nullopt;
}

ViewSelection select_views(const std::vector<ViewCandidate>& candidates, const Box2d& tile, double z_low, double z_high,
                           const ViewSelectionOptions& options) {
  SKY_CHECK(!options.problem());
  SKY_CHECK(!tile.empty());
  SKY_CHECK_LE(z_low, z_high);
  const std::vector<int> order = order_by_name(candidates);
  std::vector<const camera::Camera*> cameras;
  for (const int position : order) cameras.push_back(&candidates[position].camera);
  const std::vector<TileView> views = tile_views(cameras, tile, z_low, z_high, options.max_off_nadir_deg);
  const Choice choice = choose(views, options);

  ViewSelection selection;
  selection.verdicts.resize(candidates.size());
  std::vector<const ViewCandidate*> chosen;
  for (const int v : choice.views) {
    chosen.push_back(&candidates[order[v]]);
    ViewVerdict& verdict = selection.verdicts[order[v]];
    verdict.chosen = true;
    verdict.rank = static_cast<int>(chosen.size());
  }
  const Vec3d middle{0.5 * (tile.min.x + tile.max.x), 0.5 * (tile.min.y + tile.max.y), 0.5 * (z_low + z_high)};
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ViewCandidate& candidate = candidates[order[v]];
    ViewVerdict& verdict = selection.verdicts[order[v]];
    const Vec3d to_camera = candidate.camera.pose().center - middle;
    verdict.name = candidate.name;
    verdict.coverage = views[v].coverage;
    verdict.off_nadir_deg = std::atan2(std::hypot(to_camera.x, to_camera.y), to_camera.z) * 180 / std::numbers::pi;
    verdict.gsd_m = candidate.camera.gsd(std::max(0.0, candidate.camera.depth(middle)));
    verdict.reason = reason_of(verdict, views[v], choice, candidate, chosen, options);
    if (verdict.chosen) selection.chosen.push_back(order[v]);
  }
  return selection;
}

}  // namespace skysweep::index
