// SPDX-License-Identifier: Apache-2.0
#include "raster/color_blocks.h"

#include <algorithm>

#include "core/check.h"
#include "core/error.h"
#include "raster/gdal/session.h"

namespace skysweep::raster {

namespace {
constexpr int kBlockCells = 512;
}

void write_color_blocks(const std::filesystem::path& path, int width, int height,
                        const std::function<Array2d<Rgba8>(const Window&)>& block, const OnProgress& progress) {
  const GdalSession gdal;
  CPLStringList options;
  for (const char* option :
       {"COMPRESS=DEFLATE", "ZLEVEL=1", "PREDICTOR=2", "TILED=YES", "BLOCKXSIZE=512", "BLOCKYSIZE=512",
        "PHOTOMETRIC=RGB", "ALPHA=NON-PREMULTIPLIED", "INTERLEAVE=PIXEL", "BIGTIFF=IF_SAFER", "SPARSE_OK=TRUE"})
    options.AddString(option);
  const auto fail = [&] {
    throw failure("cannot write " + path.string() + ": " + gdal.reason("GDAL gives no reason"));
  };
  GDALDriver& driver = *GetGDALDriverManager()->GetDriverByName("GTiff");
  DatasetPtr file(driver.Create(path.c_str(), width, height, 4, GDT_Byte, options.List()));
  if (!file) fail();
  for (int row = 0; row < height; row += kBlockCells) {
    for (int column = 0; column < width; column += kBlockCells) {
      const Window window{column, row, std::min(kBlockCells, width - column), std::min(kBlockCells, height - row)};
      Array2d<Rgba8> cells = block(window);
      SKY_CHECK(cells.width() == window.width && cells.height() == window.height);
      if (file->RasterIO(GF_Write, column, row, window.width, window.height, cells.data(), window.width, window.height,
                         GDT_Byte, 4, nullptr, sizeof(Rgba8), static_cast<GSpacing>(sizeof(Rgba8)) * window.width, 1,
                         nullptr) != CE_None)
        fail();
    }
    if (progress && !progress(std::min(1.0, static_cast<double>(row + kBlockCells) / height))) throw Stopped{};
  }
  file.reset();
  if (!gdal.first_error().empty()) fail();
}

}  // namespace skysweep::raster
