// SPDX-License-Identifier: Apache-2.0
#include "raster/cog.h"

#include <cpl_string.h>

#include <algorithm>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "raster/atomic_file.h"
#include "raster/gdal/labels.h"
#include "raster/gdal/session.h"

namespace skysweep::raster {

namespace fs = std::filesystem;

namespace {

constexpr int kBlockCells = 512;

GDALDataType type_of(CogKind kind) {
  return kind == CogKind::values || kind == CogKind::deviations ? GDT_Float32 : GDT_Byte;
}

int bands_of(CogKind kind) { return kind == CogKind::colors ? 4 : 1; }

const char* overview_resampling(CogKind kind) {
  switch (kind) {
    case CogKind::values: return "AVERAGE";
    case CogKind::deviations: return "RMS";
    case CogKind::colors: return "AVERAGE";
    case CogKind::classes: return "MODE";
  }
  return "NEAREST";
}

CPLStringList creation_options(CogKind kind) {
  // STANDARD: difference to the neighbour, of colours; long runs of classes are best left alone.
  const char* predictor = type_of(kind) == GDT_Float32 ? "FLOATING_POINT" : kind == CogKind::colors ? "STANDARD" : "NO";
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("LEVEL", "1");  // 1 to 2 % larger than level 6 on a dense town, in two thirds of the time
  options.SetNameValue("PREDICTOR", predictor);
  options.SetNameValue("OVERVIEW_PREDICTOR", predictor);
  options.SetNameValue("OVERVIEW_RESAMPLING", overview_resampling(kind));
  options.SetNameValue("BLOCKSIZE", std::to_string(kBlockCells).c_str());
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  return options;
}

std::string escaped(const std::string& text) {
  char* xml = CPLEscapeString(text.c_str(), static_cast<int>(text.size()), CPLES_XML);
  std::string result = xml;
  CPLFree(xml);
  return result;
}

// The part of a source inside the mosaic as an element of GDAL's VRT format. With its properties given, GDAL opens the
// file only when its cells are asked for, and keeps few files open at a time.
std::string source_element(const CogSource& source, const Cog& cog, int band) {
  const int west = std::max(source.column, 0), east = std::min(source.column + source.width, cog.width);
  const int north = std::max(source.row, 0), south = std::min(source.row + source.height, cog.height);
  if (west >= east || north >= south) return {};
  const auto attributes = [&](int column, int row) {
    return "xOff=\"" + std::to_string(column) + "\" yOff=\"" + std::to_string(row) + "\" xSize=\"" +
           std::to_string(east - west) + "\" ySize=\"" + std::to_string(south - north) + "\"";
  };
  return "<SimpleSource><SourceFilename relativeToVRT=\"0\">" + escaped(fs::absolute(source.path).string()) +
         "</SourceFilename><SourceBand>" + std::to_string(band) + "</SourceBand><SourceProperties RasterXSize=\"" +
         std::to_string(source.width) + "\" RasterYSize=\"" + std::to_string(source.height) + "\" DataType=\"" +
         GDALGetDataTypeName(type_of(cog.kind)) + "\" BlockXSize=\"256\" BlockYSize=\"256\"/><SrcRect " +
         attributes(west - source.column, north - source.row) + "/><DstRect " + attributes(west, north) +
         "/></SimpleSource>";
}

// The mosaic as GDAL sees it: a raster that reads from the sources and holds no cells itself.
DatasetPtr virtual_mosaic(const Cog& cog) {
  GDALDriver& driver = *GetGDALDriverManager()->GetDriverByName("VRT");
  DatasetPtr mosaic(driver.Create("", cog.width, cog.height, 0, type_of(cog.kind), nullptr));
  constexpr GDALColorInterp kChannels[] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand};
  for (int number = 1; number <= bands_of(cog.kind); ++number) {
    mosaic->AddBand(type_of(cog.kind), nullptr);
    GDALRasterBand& band = *mosaic->GetRasterBand(number);
    for (const CogSource& source : cog.sources) {
      const std::string element = source_element(source, cog, number);
      if (!element.empty()) band.SetMetadataItem("source", element.c_str(), "new_vrt_sources");
    }
    if (cog.kind == CogKind::colors) band.SetColorInterpretation(kChannels[number - 1]);
    if (cog.kind == CogKind::classes) band.SetNoDataValue(0);
    if (type_of(cog.kind) == GDT_Float32) band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  }
  put_georeference(*mosaic, cog.georeference);
  put_labels(*mosaic, cog.labels);
  return mosaic;
}

// GDAL names the reason of a failed read, but not always the file.
void blame_a_source(const Cog& cog) {
  for (const CogSource& source : cog.sources) {
    if (cog.kind == CogKind::colors)
      read_color_raster(source.path);
    else if (cog.kind == CogKind::classes)
      read_class_raster(source.path);
    else
      read_float_raster(source.path);
  }
}

}  // namespace

void write_cog(const fs::path& path, const Cog& cog) {
  SKY_CHECK(cog.width > 0 && cog.height > 0);
  write_atomically(path, [&](const fs::path& temporary) {
    GdalSession gdal;
    const DatasetPtr mosaic = virtual_mosaic(cog);
    GDALDriver& driver = *GetGDALDriverManager()->GetDriverByName("COG");
    DatasetPtr written(
        driver.CreateCopy(temporary.c_str(), mosaic.get(), TRUE, creation_options(cog.kind).List(), nullptr, nullptr));
    const bool complete = written != nullptr;
    written.reset();  // writes the last blocks; what goes wrong then is known only to the session
    if (complete && gdal.first_error().empty()) return;
    blame_a_source(cog);
    throw failure("cannot write " + path.string() + ": " + gdal.reason("GDAL gives no reason"));
  });
}

}  // namespace skysweep::raster
