// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_job.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "pipeline/tile_digest.h"
#include "pipeline/tile_geometry.h"
#include "sweep/luminance_gains.h"

namespace skysweep::pipeline {
namespace {

using index::ImageRecord;

std::vector<std::shared_ptr<const sweep::ImagePyramid>> load_photographs(const std::vector<std::string>& names,
                                                                         PhotoCache& photos, Executor& executor) {
  std::vector<std::shared_ptr<const sweep::ImagePyramid>> images(names.size());
  executor.parallel_for(static_cast<int>(names.size()), [&](int i) {
    try {
      images[i] = photos.get(names[i]);
    } catch (const Error& error) {
      throw PhotographFailed(names[i], error.what());
    }
  });
  return images;
}

// A plane amid the heights on the cells of the coarse sweep.
Array2d<float> level_surface(const sweep::HeightRange& heights, const sweep::Grid& grid) {
  const auto cells = [](int fine) { return (fine + sweep::kCoarseCells - 1) / sweep::kCoarseCells; };
  return {cells(grid.width), cells(grid.height), static_cast<float>((heights.z_low + heights.z_high) / 2)};
}

template <typename T>
Array2d<T> without_collar(const Array2d<T>& values, const TileOptions& options) {
  return crop(values, options.collar_cells, options.collar_cells, options.cells, options.cells);
}

tiles::Tile tile_from(const sweep::SweepResult& result, const TileOptions& options) {
  tiles::Tile tile;
  tile.dem = without_collar(result.height_m, options);
  tile.confidence = without_collar(result.sigma_m, options);
  tile.color = without_collar(result.color, options);
  const Array2d<std::uint8_t> filled = without_collar(result.filled, options);
  const Array2d<std::uint8_t> planar = without_collar(result.planar, options);
  tile.mask = Array2d<std::uint8_t>(options.cells, options.cells);
  for (std::size_t i = 0; i < tile.mask.size(); ++i) {
    const bool has_height = !std::isnan(tile.dem.data()[i]);
    const tiles::CellSource source = filled.data()[i] != 0   ? tiles::CellSource::filled
                                     : has_height            ? tiles::CellSource::measured
                                     : planar.data()[i] != 0 ? tiles::CellSource::planar
                                                             : tiles::CellSource::none;
    tile.mask.data()[i] = static_cast<std::uint8_t>(source);
  }
  return tile;
}

double share_with_height(const Array2d<float>& dem) {
  const auto known = std::count_if(dem.begin(), dem.end(), [](float z) { return !std::isnan(z); });
  return static_cast<double>(known) / static_cast<double>(dem.size());
}

std::uint64_t count_of(const Array2d<std::uint8_t>& mask, tiles::CellSource source) {
  return static_cast<std::uint64_t>(std::count(mask.begin(), mask.end(), static_cast<std::uint8_t>(source)));
}

}  // namespace

PreparedTile prepare_tile(tiles::TileKey key, const std::vector<const ImageRecord*>& candidates,
                          const ProjectSettings& settings, PhotoCache& photos, Executor& executor) {
  const TileGeometry geometry(key, candidates, settings);
  PreparedTile prepared;
  TileInputs inputs;
  prepared.problem = geometry.empty_problem();

  // The ground is first guessed below the cameras, then found by a coarse sweep with the views that serve the guess.
  prepared.selection = inputs.guess = geometry.select(geometry.guessed_heights());
  prepared.images = load_photographs(geometry.names(prepared.selection), photos, executor);
  prepared.problem.views = geometry.views(prepared.selection, prepared.images, geometry.guessed_heights());
  if (prepared.problem.views.size() >= 2) {
    const sweep::HeightRange search = geometry.searched_heights();
    sweep::equalize_luminance(level_surface(geometry.guessed_heights(), prepared.problem.grid), executor,
                              prepared.problem);
    prepared.coarse_surface =
        sweep::coarse_surface(prepared.problem, search.z_low, search.z_high, settings.backend, executor);
    prepared.heights = sweep::search_near(prepared.coarse_surface, prepared.problem);
  }
  if (prepared.heights) {
    prepared.selection = geometry.select(*prepared.heights);
    prepared.images = load_photographs(geometry.names(prepared.selection), photos, executor);
    prepared.problem.views = geometry.views(prepared.selection, prepared.images, *prepared.heights);
    sweep::equalize_luminance(prepared.coarse_surface, executor, prepared.problem);
  }
  prepared.view_names = geometry.names(prepared.selection);
  inputs.heights = prepared.heights;
  inputs.chosen = prepared.selection;
  prepared.input_digest = inputs.digest(key, geometry, candidates, settings_digest(settings));
  return prepared;
}

TileOutcome compute_tile(tiles::TileKey key, const std::vector<const ImageRecord*>& candidates,
                         const ProjectSettings& settings, PhotoCache& photos, Executor& executor) {
  const PreparedTile prepared = prepare_tile(key, candidates, settings, photos, executor);
  const sweep::SweepResult result = sweep::plane_sweep(prepared.problem, settings.backend, executor);
  TileOutcome outcome;
  outcome.tile = tile_from(result, settings.configuration.tiles);
  outcome.input_digest = prepared.input_digest;
  outcome.views = prepared.view_names;
  outcome.heights = prepared.heights;
  if (outcome.heights) outcome.tile.searched = {outcome.heights->z_low, outcome.heights->z_high};
  outcome.valid_share = share_with_height(outcome.tile.dem);
  outcome.cells_measured = count_of(outcome.tile.mask, tiles::CellSource::measured);
  outcome.cells_filled = count_of(outcome.tile.mask, tiles::CellSource::filled);
  outcome.samples = result.samples;
  return outcome;
}

bool TileOutcome::empty() const {
  return valid_share == 0 && std::all_of(tile.color.begin(), tile.color.end(), [](Rgba8 c) { return c.a == 0; });
}

}  // namespace skysweep::pipeline
