// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "app/commands/commands.h"
#include "app/printable.h"
#include "core/error.h"
#include "formats/pose_set.h"
#include "index/catalogue.h"
#include "pipeline/coverage.h"
#include "pipeline/tile_check.h"
#include "pipeline/tile_geometry.h"
#include "raster/crs.h"
#include "raster/digest.h"
#include "raster/file_stamp.h"
#include "raster/photo.h"

namespace skysweep::app {
namespace {

struct InfoOptions {
  std::string path;
  std::optional<std::string> tile;
};

void print(const std::string& line) { std::puts(printable(line).c_str()); }

void print_project(const pipeline::ProjectPaths& paths) {
  const pipeline::ProjectSettings s = pipeline::read_project(paths);
  const index::Catalogue catalogue = index::Catalogue::open_existing(paths.catalogue());
  const std::vector<index::ImageRecord> images = catalogue.images();
  std::vector<index::TileRecord> tiles = catalogue.tiles();
  std::erase_if(tiles, [](const index::TileRecord& tile) { return tile.level > 0; });
  std::printf("project    %s\nCRS        %s\nheights    %s\n", paths.folder.c_str(),
              raster::crs_name(s.crs_wkt).c_str(), raster::vertical_reference(s.crs_wkt).c_str());
  std::printf("lattice    cells of %g m, tiles of %d x %d cells, plane step %g m\n", s.lattice.cell_m,
              s.lattice.tile_cells, s.lattice.tile_cells, s.lattice.dz_m);
  std::printf("ground     about %.4g m below the cameras\nbackend    %s %s\n", s.search.ground_depth_m,
              sweep::to_string(s.backend), (s.instruction_set + s.gpu_device).c_str());
  int used = 0;
  for (const index::ImageRecord& image : images) used += image.status == index::ImageStatus::used;
  std::printf("photos     %d of %zu used, from %s\n", used, images.size(), s.images.c_str());
  double share = 0, seconds = 0;
  for (const index::TileRecord& tile : tiles) {
    share += tile.valid_share;
    seconds += tile.seconds;
  }
  std::printf("tiles      %zu, %.1f %% of their cells with height, %.1f s of work\n", tiles.size(),
              tiles.empty() ? 0.0 : 100 * share / static_cast<double>(tiles.size()), seconds);
  for (const index::ImageRecord& image : images)
    if (image.status != index::ImageStatus::used)
      print(std::string(index::to_string(image.status)) + "    " + image.name + ": " + image.reason);
}

// The photographs with their bytes as they are on disk now; their poses are those of the last run.
std::vector<index::ImageRecord> looked_at_again(std::vector<index::ImageRecord> images,
                                                const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    print("The photographs' folder " + folder.string() + " is not there: judged by what the last run saw.");
    return images;
  }
  for (index::ImageRecord& image : images) {
    if (image.status != index::ImageStatus::used) continue;
    const std::optional<std::string> stamp = raster::file_stamp(folder / image.name);
    if (!stamp) {
      image.status = index::ImageStatus::refused;
      image.reason = "its file is gone.";
    } else if (*stamp != image.stamp) {
      image.content_digest = raster::digest_of_file(folder / image.name);
    }
  }
  return images;
}

// Whether the next run would compute a tile, and why.
void print_state(const pipeline::ProjectPaths& paths, const pipeline::ProjectSettings& settings, tiles::TileKey key,
                 const index::TileRecord* row, const std::vector<index::ImageRecord>& images) {
  const std::vector<index::ImageRecord> now = looked_at_again(images, settings.images);
  const pipeline::Coverage coverage(now, settings);
  const auto candidates = coverage.candidates(key);
  if (static_cast<int>(candidates.size()) < settings.configuration.sweep.min_views)
    return print("It is touched by " + std::to_string(candidates.size()) + " photographs, too few for a tile.");
  const tiles::TileStore store = pipeline::open_store(paths, settings);
  const pipeline::TileCheck check = pipeline::TileChecker(settings, store, false).check(key, coverage, row);
  print(std::string(check.fresh ? "It is up to date: " : "It is stale, the next run computes it: ") + check.why + ".");
}

// Which photographs serve a tile, and why the others do not.
void print_tile(const pipeline::ProjectPaths& paths, const std::string& name) {
  const auto key = tiles::TileKey::parse(name);
  if (!key || key->level != 0)
    throw usage_error("--tile takes the name of a level-0 tile, such as l0x-7y4, not '" + name + "'.");
  const pipeline::ProjectSettings settings = pipeline::read_project(paths);
  const index::Catalogue catalogue = index::Catalogue::open_existing(paths.catalogue());
  const std::vector<index::ImageRecord> images = catalogue.images();
  const auto candidates = pipeline::Coverage(images, settings).candidates(*key);
  const pipeline::TileGeometry geometry(*key, candidates, settings);
  sweep::HeightRange heights = geometry.guessed_heights();
  const std::vector<index::TileRecord> tiles = catalogue.tiles();
  const auto tile = std::find_if(tiles.begin(), tiles.end(), [&](const auto& t) { return t.name == key->name(); });
  if (tile == tiles.end()) {
    std::printf("%s has not been computed; the ground is guessed at %.2f m\n", name.c_str(), heights.z_low);
  } else {
    std::printf("%s: %.1f %% of its cells have a height; surfaces found from %.2f to %.2f m; %.1f s\n", name.c_str(),
                100 * tile->valid_share, tile->z_low, tile->z_high, tile->seconds);
    if (!tile->views.empty() && tile->z_high > tile->z_low) heights = {tile->z_low, tile->z_high};
  }
  print_state(paths, settings, *key, tile == tiles.end() ? nullptr : &*tile, images);
  for (const index::ViewVerdict& v : geometry.select(heights).verdicts) {
    std::printf("%s %-24s %5.1f %% of the tile, %4.1f degrees from nadir, GSD %.3f m: %s\n",
                v.chosen ? "used    " : "not used", printable(v.name).c_str(), 100 * v.coverage, v.off_nadir_deg,
                v.gsd_m, v.reason.c_str());
  }
}

void print_poses(const std::string& path) {
  const formats::PoseSet poses = formats::read_poses(path);
  std::printf("%zu photographs with poses, %zu refused\n", poses.images.size(), poses.refused.size());
  for (const std::string& note : poses.notes) print("note     " + note);
  for (const formats::RefusedImage& image : poses.refused) print("refused  " + image.reason);
  for (const formats::PosedImage& image : poses.images) {
    const Vec3d c = image.pose.center;
    std::printf("%-24s at %.3f %.3f %.3f, %4.1f degrees from nadir, %d x %d, f %.1f px\n",
                printable(image.name).c_str(), c.x, c.y, c.z, camera::off_nadir_deg(image.pose), image.model.width_px,
                image.model.height_px, image.model.focal_px());
  }
}

int info(const InfoOptions& options) {
  const pipeline::ProjectPaths paths(options.path);
  const bool project = pipeline::project_exists(paths);
  if (options.tile && !project) throw usage_error("--tile needs a project folder; " + options.path + " is none.");
  if (options.tile)
    print_tile(paths, *options.tile);
  else if (project)
    print_project(paths);
  else
    print_poses(options.path);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& program, ChosenCommand& chosen) {
  CLI::App* command = program.add_subcommand("info", "What a project, one of its tiles, or a pose file holds.");
  auto o = std::make_shared<InfoOptions>();
  command->add_option("PATH", o->path, "Project folder or pose file")->required();
  command->add_option("--tile", o->tile,
                      "Explain whether this tile is up to date and which photographs serve it, e.g. l0x-7y4");
  command->callback([o, &chosen] { chosen = [o] { return info(*o); }; });
}

}  // namespace skysweep::app
