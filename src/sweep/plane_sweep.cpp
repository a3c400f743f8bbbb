// SPDX-License-Identifier: Apache-2.0
#include "sweep/plane_sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sweep/coarse_to_fine.h"
#include "sweep/filling.h"
#include "sweep/height_sigma.h"
#include "sweep/heights.h"
#include "sweep/orthophoto.h"
#include "sweep/photometric_evidence.h"
#include "sweep/speckles.h"
#include "sweep/step_edges.h"

namespace skysweep::sweep {

namespace {

// Heights of the search, where something distinguishes them.
Heights distinct_heights(const SweepProblem& problem, const Search& found, Executor& executor) {
  Heights heights = heights_from_matches(problem, found.matches);
  const auto keep = [&](const SweepProblem& planes, const Array2d<float>& mean_cost, double mean_error, Heights& kept) {
    MatchResult matches = found.matches;
    if (!mean_cost.empty()) matches.mean_cost = mean_cost;
    drop_heights_without_evidence(planes, matches, executor, kept, mean_error);
  };
  if (found.all_mean.empty()) {
    keep(problem, {}, 0, heights);
    return heights;
  }
  // Either mean is evidence, but only against the photographs that come and go over its own planes.
  Heights by_searched = heights;
  keep(found.problem, found.searched_mean, 0, by_searched);
  // The coarse grid counted the views at other places and planes.
  keep(problem, found.all_mean, 0.5 * problem.options.few_views_penalty, heights);
  for (std::size_t i = 0; i < heights.height_m.size(); ++i) {
    if (!std::isnan(heights.height_m.data()[i])) continue;
    heights.height_m.data()[i] = by_searched.height_m.data()[i];
    heights.sigma_m.data()[i] = by_searched.sigma_m.data()[i];
  }
  return heights;
}

}  // namespace

Search search(const SweepProblem& problem, Backend backend, Executor& executor) {
  Search found;
  if (problem.options.coarse_levels == 0) {
    found.problem = problem;
    found.samples = sample_count(problem);
    found.matches = match_planes(problem, backend, executor);
    return found;
  }
  NarrowedSearch narrowed = narrow_search(problem, backend, executor, found.samples);
  found.problem = std::move(narrowed.problem);
  found.samples += sample_count(found.problem);
  found.matches = match_planes(found.problem, backend, executor);
  found.searched_mean = found.matches.mean_cost;
  found.all_mean = std::move(narrowed.mean_cost);
  // On weak texture the coarse grid's mean has less noise than any cost here, right or wrong.
  for (std::size_t i = 0; i < found.all_mean.size(); ++i)
    found.matches.mean_cost.data()[i] = std::max(found.searched_mean.data()[i], found.all_mean.data()[i]);
  return found;
}

SweptSurface surface_of(const SweepProblem& problem, const Search& found, Executor& executor) {
  SweptSurface out;
  out.heights = distinct_heights(problem, found, executor);
  out.matched_height_m = out.heights.height_m;
  drop_speckles(problem, out.heights);
  EdgeEvidence edges;
  if (problem.options.edge_passes > 0) {
    set_sigma(problem, found.matches, out.heights);  // of what edges are settled from, not of what they become
    edges = settle_edges(problem, executor, out.heights);
  }
  out.signs = sigma_signs(problem, found.matches, out.heights.height_m, std::move(edges));
  out.heights.sigma_m = height_sigma(out.heights.height_m, out.signs, problem.dz_m);
  out.filled = fill_hidden_cells(problem, executor, out.heights);
  return out;
}

SweepResult plane_sweep(const SweepProblem& problem, Backend backend, Executor& executor) {
  problem.check();
  SweepResult result;
  const Search found = search(problem, backend, executor);
  result.samples = found.samples;
  SweptSurface surface = surface_of(problem, found, executor);
  result.height_m = std::move(surface.heights.height_m);
  result.sigma_m = std::move(surface.heights.sigma_m);
  result.filled = std::move(surface.filled);
  colorize(problem, executor, result);
  return result;
}

}  // namespace skysweep::sweep
