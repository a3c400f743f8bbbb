// SPDX-License-Identifier: Apache-2.0
#include "app/finish_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/option_values.h"
#include "export/mosaic.h"
#include "pipeline/tbb_executor.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"
#include "raster/geotiff.h"
#include "raster/hillshade.h"
#include "raster/photo.h"

namespace skysweep::app {
namespace {

struct Mosaic {
  const char* layer;
  const char* file;
};
constexpr std::array<Mosaic, 4> kMosaics = {
    {{"dem", "dsm"}, {"color", "ortho"}, {"confidence", "confidence"}, {"mask", "mask"}}};
constexpr int kPreviewPixels = 1600;  // the preview's longer side is at most this

Box2d intersection(const Box2d& a, const Box2d& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

// Every n-th cell: for a picture that says what the surface looks like.
raster::Raster<float> thinned(const raster::Raster<float>& dsm) {
  const int longer = std::max(dsm.values.width(), dsm.values.height());
  const int step = std::max(1, (longer + kPreviewPixels - 1) / kPreviewPixels);
  raster::Raster<float> out{
      Array2d<float>(dsm.values.width() / step, dsm.values.height() / step), dsm.georeference, {}};
  out.georeference.cell_m *= step;
  for (int y = 0; y < out.values.height(); ++y)
    for (int x = 0; x < out.values.width(); ++x) out.values(x, y) = dsm.values(x * step, y * step);
  return out;
}

// Mosaics and preview; false if no cell of the map is known.
bool write_products(const pipeline::RunRequest& request, const pipeline::RunSummary& summary, Console& console) {
  const pipeline::ProjectPaths paths(request.project);
  const tiles::TileStore store = pipeline::open_store(paths, summary.settings);
  Box2d extent = exports::known_extent(store);
  if (request.area) extent = intersection(extent, *request.area);
  if (extent.empty()) return false;
  console.begin("mosaics", static_cast<int>(kMosaics.size()) + 1);
  pipeline::TbbExecutor executor(request.threads);
  executor.parallel_for(static_cast<int>(kMosaics.size()), [&](int i) {
    exports::write_mosaic(store, kMosaics[i].layer, extent, paths.mosaic(kMosaics[i].file));
    console.advance();
  });
  const raster::Raster<float> dsm = raster::read_float_raster(paths.mosaic("dsm"));
  raster::write_image(paths.folder / "preview.png", raster::hillshade(thinned(dsm)));
  console.advance();
  return true;
}

nlohmann::json report_of(const pipeline::RunSummary& summary, double seconds) {
  const pipeline::ProjectSettings& s = summary.settings;
  nlohmann::json images = nlohmann::json::array();
  for (const index::ImageRecord& image : summary.images) {
    nlohmann::json entry{{"name", image.name}, {"status", index::to_string(image.status)}};
    if (!image.reason.empty()) entry["reason"] = image.reason;
    images.push_back(entry);
  }
  return {{"software", pipeline::software_name()},
          {"crs", raster::crs_name(s.crs_wkt)},
          {"vertical_reference", raster::vertical_reference(s.crs_wkt)},
          {"cell_m", s.lattice.cell_m},
          {"dz_m", s.lattice.dz_m},
          {"ground_depth_m", s.search.ground_depth_m},
          {"backend", sweep::to_string(s.backend)},
          {"instruction_set", s.instruction_set},
          {"gpu_device", s.gpu_device},
          {"tiles",
           {{"planned", summary.tiles_planned},
            {"computed", summary.tiles_computed},
            {"kept", summary.tiles_kept},
            {"empty", summary.tiles_empty},
            {"parents_written", summary.parents_written}}},
          {"cells", {{"measured", summary.cells_measured}, {"filled", summary.cells_filled}}},
          {"samples", summary.samples},
          {"photographs_decoded", summary.photographs_decoded},
          {"seconds", seconds},
          {"peak_memory_bytes", peak_resident_memory()},
          {"interrupted", summary.interrupted},
          {"images", images}};
}

void say_summary(const pipeline::RunSummary& summary, const std::filesystem::path& folder, bool has_map, double seconds,
                 Console& console) {
  char text[160];
  std::snprintf(text, sizeof text, "%d tiles computed, %d kept, %d empty, in %.1f s; peak memory %s.",
                summary.tiles_computed, summary.tiles_kept, summary.tiles_empty, seconds,
                memory_text(peak_resident_memory()).c_str());
  console.say(text);
  const auto refused = std::count_if(summary.images.begin(), summary.images.end(),
                                     [](const auto& image) { return image.status == index::ImageStatus::refused; });
  if (refused > 0)
    console.say(std::to_string(refused) + " of " + std::to_string(summary.images.size()) +
                " photographs were refused; " + (folder / "report.json").string() + " says why.");
  const pipeline::ProjectSettings& s = summary.settings;
  console.say("CRS: " + raster::crs_name(s.crs_wkt) + ". Heights: " + raster::vertical_reference(s.crs_wkt) + ".");
  console.say(has_map
                  ? "The map: " + (folder / "dsm.tif").string() + ", " + (folder / "ortho.tif").string() + ", " +
                        (folder / "preview.png").string()
                  : "No height could be measured anywhere; " + (folder / "report.json").string() + " may tell why.");
  if (summary.interrupted) console.say("Interrupted. The same command goes on from here.");
}

}  // namespace

void finish_run(const pipeline::RunRequest& request, const pipeline::RunSummary& summary,
                std::chrono::steady_clock::time_point start, Console& console) {
  const pipeline::ProjectPaths paths(request.project);
  const bool products_there =
      std::filesystem::exists(paths.mosaic("dsm")) && std::filesystem::exists(paths.mosaic("mask"));
  const bool wanted = summary.changed() || !products_there || request.area;
  const bool has_map = !summary.interrupted && wanted ? write_products(request, summary, console) : products_there;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  raster::write_bytes_atomically(
      paths.folder / "report.json",
      report_of(summary, seconds).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  say_summary(summary, paths.folder, has_map, seconds, console);
}

}  // namespace skysweep::app
