// SPDX-License-Identifier: Apache-2.0
#include "app/finish_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/option_values.h"
#include "core/error.h"
#include "export/mosaic.h"
#include "index/catalogue.h"
#include "pipeline/tbb_executor.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"
#include "raster/digest.h"
#include "raster/file_stamp.h"
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

// The files made from the tiles, and what each was made from.
class Products {
 public:
  Products(const pipeline::RunRequest& request, const pipeline::RunSummary& summary)
      : paths_(request.project),
        request_(request),
        summary_(summary),
        catalogue_(paths_.catalogue(), summary.settings.crs_wkt) {
    raster::Digest digest;
    digest.add_field(summary.map_digest);
    if (request.area)
      for (const double v : {request.area->min.x, request.area->min.y, request.area->max.x, request.area->max.y})
        digest.add_field(std::to_string(v));
    digest_ = digest.hex();
  }

  // Whether all are there, as they were written, of the map as it is now.
  bool up_to_date() const {
    std::map<std::string, index::ProductRecord> recorded;
    for (const index::ProductRecord& product : catalogue_.products()) recorded[product.name] = product;
    return std::all_of(kFiles.begin(), kFiles.end(), [&](const char* file) {
      const auto found = recorded.find(file);
      return found != recorded.end() && found->second.digest == digest_ &&
             found->second.stamp == raster::file_stamp(paths_.folder / file);
    });
  }

  // False if no cell of the map is known; then there are none.
  bool write(Console& console) {
    const tiles::TileStore store = pipeline::open_store(paths_, summary_.settings);
    Box2d extent = exports::known_extent(store);
    if (request_.area) extent = intersection(extent, *request_.area);
    if (extent.empty()) {
      remove();
      return false;
    }
    console.begin("mosaics", static_cast<int>(kMosaics.size()) + 1);
    pipeline::TbbExecutor executor(request_.threads);
    executor.parallel_for(static_cast<int>(kMosaics.size()), [&](int i) {
      exports::write_mosaic(store, kMosaics[i].layer, extent, paths_.mosaic(kMosaics[i].file));
      console.advance();
    });
    const raster::Raster<float> dsm = raster::read_float_raster(paths_.mosaic("dsm"));
    raster::write_image(paths_.folder / "preview.png", raster::hillshade(thinned(dsm)));
    console.advance();
    record();
    return true;
  }

 private:
  static constexpr std::array kFiles = {"dsm.tif", "ortho.tif", "confidence.tif", "mask.tif", "preview.png"};

  void record() {
    std::vector<index::ProductRecord> products;
    for (const char* file : kFiles)
      products.push_back({file, digest_, raster::file_stamp(paths_.folder / file).value_or("")});
    catalogue_.put_products(products);
  }

  // Of a map that had heights once: nobody shall take them for this one.
  void remove() {
    std::error_code ignored;
    for (const char* file : kFiles) std::filesystem::remove(paths_.folder / file, ignored);
    catalogue_.remove_products({kFiles.begin(), kFiles.end()});
  }

  pipeline::ProjectPaths paths_;
  const pipeline::RunRequest& request_;
  const pipeline::RunSummary& summary_;
  index::Catalogue catalogue_;
  std::string digest_;
};

// A tile that went bad since its sizes and times were looked at.
Error with_advice(const Error& error) {
  if (error.kind() != ErrorKind::bad_input) return error;
  return {error.kind(), std::string(error.what()) + "; run again with --verify, which makes damaged tiles anew"};
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
            {"removed", summary.tiles_removed},
            {"parents_written", summary.parents_written},
            {"quadrants_made", summary.quadrants_made}}},
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
  Products products(request, summary);
  bool has_map = true;
  try {
    if (summary.interrupted)
      has_map = std::filesystem::exists(paths.mosaic("dsm"));
    else if (!products.up_to_date())
      has_map = products.write(console);
  } catch (const Error& error) {
    throw with_advice(error);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  raster::write_bytes_atomically(
      paths.folder / "report.json",
      report_of(summary, seconds).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  say_summary(summary, paths.folder, has_map, seconds, console);
}

}  // namespace skysweep::app
