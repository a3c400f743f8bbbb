// SPDX-License-Identifier: Apache-2.0
// One tile of a project again, every stage written out: for finding out why a tile looks as it does.
#include <fstream>
#include <thread>

#include "app/commands/commands.h"
#include "app/console.h"
#include "core/error.h"
#include "index/catalogue.h"
#include "pipeline/coverage.h"
#include "pipeline/open_project.h"
#include "pipeline/tbb_executor.h"
#include "pipeline/tile_job.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"
#include "sweep/orthophoto.h"
#include "sweep/plane_sweep.h"

namespace skysweep::app {
namespace {

struct SweepOptions {
  std::string project, tile, folder;
  std::optional<std::string> images;
};

constexpr std::size_t kPhotoCacheBytes = std::size_t{1} << 30;

class StageWriter {
 public:
  StageWriter(std::filesystem::path folder, raster::GeoReference georeference, std::string vertical_reference)
      : folder_(std::move(folder)),
        georeference_(std::move(georeference)),
        vertical_reference_(std::move(vertical_reference)) {
    raster::require_writable_folder(folder_);
  }

  template <typename T>
  void write(const std::string& name, const Array2d<T>& values, const std::string& content, const std::string& units,
             bool is_height = false) {
    raster::Raster<T> out{values, georeference_, {}};
    out.labels = {content, units, is_height ? vertical_reference_ : "", pipeline::software_name(), ""};
    raster::write_geotiff(folder_ / (name + ".tif"), out);
  }

 private:
  std::filesystem::path folder_;
  raster::GeoReference georeference_;
  std::string vertical_reference_;
};

template <typename To, typename From, typename Convert>
Array2d<To> converted(const Array2d<From>& values, Convert convert) {
  Array2d<To> out(values.width(), values.height());
  std::transform(values.begin(), values.end(), out.begin(), convert);
  return out;
}

// What scripts/fit_sigma.py reads.
void write_signs(const sweep::SigmaSigns& signs, StageWriter& out) {
  out.write("height_per_pixel", signs.height_per_pixel_m, "height error of one pixel", "metre");
  out.write("step_5", signs.step_5_m, "height range of 5 x 5 cells", "metre");
  out.write("step_17", signs.step_17_m, "height range of 17 x 17 cells", "metre");
  out.write("offset", signs.offset_m, "distance from the mean height of 9 x 9 cells", "metre");
  if (!signs.edges.margin.empty()) {
    out.write("edge_margin", signs.edges.margin, "how much more the next best surface at a step costs", "");
    out.write("edge_difference", signs.edges.difference, "difference between the colours of the chosen one", "");
  }
  out.write("excess_3", signs.excess_3, "how much more the rival costs, 3 x 3 cells", "grey level");
  out.write("excess_9", signs.excess_9, "how much more the rival costs, 9 x 9 cells", "grey level");
  out.write("undecided", signs.undecided, "share of undecided cells, 17 x 17 cells", "");
  out.write("bend_9", signs.bend_9, "mean bend, 9 x 9 cells", "grey level");
  out.write("cost_9", signs.cost_9, "mean cost, 9 x 9 cells", "grey level");
  out.write("cost_17", signs.cost_17, "mean cost, 17 x 17 cells", "grey level");
}

std::string selection_text(const pipeline::PreparedTile& tile) {
  std::string text = tile.heights ? "heights found by the coarse sweep: " + std::to_string(tile.heights->z_low) +
                                        " to " + std::to_string(tile.heights->z_high) + " m\n"
                                  : "the coarse sweep found nothing\n";
  for (const index::ViewVerdict& verdict : tile.selection.verdicts)
    text += (verdict.chosen ? "used     " : "not used ") + verdict.name + ": " + verdict.reason + "\n";
  return text;
}

int dump_tile(const SweepOptions& options) {
  const pipeline::ProjectPaths paths(options.project);
  if (!pipeline::project_exists(paths))
    throw bad_input(options.project + " holds no project (project.toml is missing).");
  const auto key = tiles::TileKey::parse(options.tile);
  if (!key || key->level != 0)
    throw usage_error("--tile takes the name of a level-0 tile, such as l0x-7y4, not '" + options.tile + "'.");
  const pipeline::ProjectSettings settings = pipeline::read_project(paths);
  pipeline::use_recorded_engine(settings);
  const std::vector<index::ImageRecord> images = index::Catalogue::open_existing(paths.catalogue()).images();
  const pipeline::Coverage coverage(images, settings);
  pipeline::PhotoCache photos(options.images ? std::filesystem::path(*options.images) : settings.images,
                              kPhotoCacheBytes, settings.configuration.sweep.normalization());
  pipeline::TbbExecutor executor(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));

  pipeline::PreparedTile tile = pipeline::prepare_tile(*key, coverage.candidates(*key), settings, photos, executor);
  tile.problem.collar_cells = 0;  // here the collar's colours are wanted, too
  const sweep::SweepProblem& problem = tile.problem;
  const sweep::Search found = sweep::search(problem, settings.backend, executor);
  const sweep::MatchResult& matches = found.matches;
  const sweep::SweptSurface surface = sweep::surface_of(problem, found, executor);
  const sweep::Heights& heights = surface.heights;
  sweep::SweepResult result;
  result.height_m = heights.height_m;
  result.filled = surface.filled;
  sweep::colorize(problem, executor, result);

  const auto write_coarse = [&](const raster::GeoReference& fine) {
    raster::Raster<float> out{tile.coarse_surface, fine, {}};
    out.georeference.cell_m *= sweep::kCoarseCells;
    out.labels = {"surface of the coarse sweep", "metre", raster::vertical_reference(settings.crs_wkt),
                  pipeline::software_name(), ""};
    if (!tile.coarse_surface.empty()) raster::write_geotiff(std::filesystem::path(options.folder) / "coarse.tif", out);
  };
  const Vec2d corner = settings.lattice.south_west_corner(*key);
  const raster::GeoReference georeference{
      settings.crs_wkt,
      {corner.x + problem.grid.north_west_corner.x, corner.y + problem.grid.north_west_corner.y},
      problem.grid.cell_m};
  StageWriter out(options.folder, georeference, raster::vertical_reference(settings.crs_wkt));
  write_coarse(georeference);
  out.write("plane", converted<float>(matches.plane, [](int k) { return static_cast<float>(k); }), "best plane", "dz");
  out.write("cost", matches.cost, "matching cost of the best plane", "grey level");
  out.write("mean_cost", matches.mean_cost, "mean matching cost over all planes", "grey level");
  out.write("fraction", matches.fraction, "vertex of the cost parabola above the best plane", "dz");
  out.write("bend", matches.bend, "second difference of the cost at the best plane", "grey level");
  out.write("rival_plane", converted<float>(matches.rival_plane, [](int k) { return static_cast<float>(k); }),
            "plane of the next best minimum", "dz");
  out.write("rival_excess", matches.rival_excess, "how much more that costs", "grey level");
  out.write("matched_height", surface.matched_height_m, "surface height before speckles are taken back", "metre", true);
  out.write("filled", result.filled, "1 where the height is that of the surroundings", "");
  out.write("height", heights.height_m, "surface height", "metre", true);
  out.write("sigma", heights.sigma_m, "standard deviation of the height", "metre");
  write_signs(surface.signs, out);
  out.write("color", result.color, "orthophoto", "");
  out.write("color_view",
            converted<std::uint8_t>(result.color_view, [](std::int8_t v) { return static_cast<std::uint8_t>(v + 1); }),
            "photograph the colour is from: line of views.txt, 0 = none", "");
  out.write("view_count", result.view_count, "photographs that see the cell", "");
  std::string views;
  for (const std::string& name : tile.view_names) views += name + "\n";
  raster::write_bytes_atomically(std::filesystem::path(options.folder) / "views.txt", views);
  raster::write_bytes_atomically(std::filesystem::path(options.folder) / "selection.txt", selection_text(tile));
  std::printf("%s: %zu photographs, %.3g samples; every stage lies in %s\n", key->name().c_str(), problem.views.size(),
              found.samples, options.folder.c_str());
  return 0;
}

}  // namespace

void add_sweep_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("sweep", "Sweep one tile of a project again and write out every stage.");
  auto o = std::make_shared<SweepOptions>();
  command->add_option("PROJECT", o->project, "Project folder")->required();
  command->add_option("--tile", o->tile, "Name of the tile, e.g. l0x-7y4")->required();
  command->add_option("--dump", o->folder, "Folder for the stages, as GeoTIFFs of the tile with its collar")
      ->required();
  command->add_option("--images", o->images, "Where the photographs lie now (default: where the project found them)");
  command->callback([o, &chosen] { chosen = [o] { return dump_tile(*o); }; });
}

}  // namespace skysweep::app
