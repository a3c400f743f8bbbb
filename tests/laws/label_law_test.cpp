// SPDX-License-Identifier: Apache-2.0
// Law: nothing is unlabelled. Every raster a project holds says its CRS, vertical reference, no-data value, units, the
// software that made it and the digest of what it was made from. No-data values are read with GDAL itself, as others
// would.
#include <gdal_priv.h>

#include <array>
#include <cmath>

#include "export/mosaic.h"
#include "laws/small_flight.h"
#include "raster/geotiff.h"

namespace skysweep::laws {
namespace {

struct Closer {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

void expect_labelled(const std::filesystem::path& path, const std::string& layer) {
  SCOPED_TRACE(path.string());
  const bool height = layer.starts_with("dem");
  const bool metres = height || layer == "confidence";
  const raster::Labels labels = raster::read_labels(path);
  EXPECT_FALSE(labels.content.empty());
  EXPECT_EQ(labels.units, metres ? "metre" : "");
  EXPECT_EQ(labels.software, pipeline::software_name());
  EXPECT_EQ(labels.input_digest.size(), 32u);
  EXPECT_EQ(labels.vertical_reference.empty(), !height);

  GDALAllRegister();
  const std::unique_ptr<GDALDataset, Closer> file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(file);
  EXPECT_NE(file->GetSpatialRef(), nullptr) << "no CRS";
  int has_no_data = 0;
  const double no_data = file->GetRasterBand(1)->GetNoDataValue(&has_no_data);
  if (layer == "color")
    EXPECT_EQ(file->GetRasterBand(4)->GetColorInterpretation(), GCI_AlphaBand);
  else
    EXPECT_TRUE(has_no_data && (metres ? std::isnan(no_data) : no_data == 0));
}

class LabelLaw : public SmallFlight, public testing::WithParamInterface<const char*> {};

TEST_P(LabelLaw, every_raster_of_a_project_is_labelled) {
  pipeline::RunRequest r = request("project");
  const std::string crs = GetParam();
  if (!crs.empty()) {
    r.crs = crs;
    r.origin = {691200, 5334016, 0};
  }
  run(r);
  const pipeline::ProjectPaths paths(r.project);
  const tiles::TileStore tiles = store(r);
  for (const std::string layer : {"dem", "color", "confidence", "mask"})
    exports::write_mosaic(tiles, layer, exports::known_extent(tiles), paths.mosaic(layer));

  int rasters = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(paths.folder)) {
    if (entry.path().extension() != ".tif") continue;
    ++rasters;
    // tiles/<layer>/...; a mosaic is named like its layer.
    const std::filesystem::path place = entry.path().lexically_relative(paths.folder);
    const bool tile = *place.begin() == "tiles";
    expect_labelled(entry.path(), tile ? std::next(place.begin())->string() : place.stem().string());
  }
  EXPECT_GT(rasters, 40);
}

INSTANTIATE_TEST_SUITE_P(Frames, LabelLaw, testing::Values("", "EPSG:32632"),
                         [](const auto& frame) { return *frame.param ? "projected" : "local"; });

}  // namespace
}  // namespace skysweep::laws
