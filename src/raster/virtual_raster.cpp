// SPDX-License-Identifier: Apache-2.0
#include "raster/virtual_raster.h"

#include <cpl_string.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>

#include "core/check.h"
#include "core/error.h"
#include "raster/gdal/labels.h"
#include "raster/gdal/session.h"
#include "raster/gdal/spatial_reference.h"

namespace skysweep::raster {

namespace fs = std::filesystem;

namespace {

GDALDataType type_of(CogKind kind) {
  return kind == CogKind::values || kind == CogKind::deviations ? GDT_Float32 : GDT_Byte;
}

int bands_of(CogKind kind) { return kind == CogKind::colors ? 4 : 1; }

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
DatasetPtr mosaic_dataset(const Cog& cog) {
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

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

const char* gdal_name(Resampling method) {
  switch (method) {
    case Resampling::nearest: return "near";
    case Resampling::bilinear: return "bilinear";
    case Resampling::cubic: return "cubic";
    case Resampling::average: return "average";
  }
  return "near";
}

// Without its vertical part: GDAL would otherwise think of converting heights.
std::string horizontal_wkt(const std::string& wkt) {
  OGRSpatialReference crs = spatial_reference_of(wkt);
  if (!crs.IsLocal()) crs.DemoteTo2D(nullptr);
  if (crs.IsCompound()) crs.StripVertical();
  return wkt_of(crs);
}

CPLStringList list_of(const std::vector<std::string>& words) {
  CPLStringList list;
  for (const std::string& word : words) list.AddString(word.c_str());
  return list;
}

std::vector<std::string> warp_arguments(CogKind kind, const Resample& to,
                                        double no_data = std::numeric_limits<double>::quiet_NaN()) {
  const GeoReference& g = to.georeference;
  const Vec2d nw = g.north_west_corner;
  const std::string scale = exact(std::min(1.0, to.scale));
  std::vector<std::string> words = {"-of", "VRT", "-ovr", "NONE", "-novshift"};
  const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  add({"-te", exact(nw.x), exact(nw.y - to.height * g.cell_m), exact(nw.x + to.width * g.cell_m), exact(nw.y)});
  add({"-ts", std::to_string(to.width), std::to_string(to.height), "-r", gdal_name(to.method)});
  // A hundredth of a cell: the exact path through PROJ for every cell takes ten times as long and moves nothing.
  add({"-et", "0.01", "-wo", "XSCALE=" + scale, "-wo", "YSCALE=" + scale});
  if (kind == CogKind::colors) add({"-srcalpha", "-dstalpha"});
  if (kind == CogKind::classes) add({"-srcnodata", "0", "-dstnodata", "0"});
  if (type_of(kind) == GDT_Float32) add({"-srcnodata", "nan", "-dstnodata", exact(no_data)});
  return words;
}

DatasetPtr warped(GDALDataset& source, const std::vector<std::string>& arguments, const GdalSession& gdal) {
  const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> options(
      GDALWarpAppOptionsNew(list_of(arguments).List(), nullptr), GDALWarpAppOptionsFree);
  GDALDatasetH sources[] = {GDALDataset::ToHandle(&source)};
  DatasetPtr result(options ? GDALDataset::FromHandle(GDALWarp("", nullptr, 1, sources, options.get(), nullptr))
                            : nullptr);
  if (!result) throw failure("the map cannot be brought to another lattice: " + gdal.reason("GDAL gives no reason"));
  return result;
}

int CPL_STDCALL tell_progress(double share, const char*, void* progress) {
  const auto& function = *static_cast<const OnProgress*>(progress);
  return !function || function(share) ? TRUE : FALSE;
}

}  // namespace

struct VirtualRaster::State {
  std::shared_ptr<const State> parent;  // declared first: the dataset reads from it and goes before it
  CogKind kind = CogKind::values;
  GeoReference georeference;
  std::function<void()> blame;  // throws Error(bad_input) naming the source that cannot be read, if one is to blame
  DatasetPtr dataset;

  static std::shared_ptr<State> child(const std::shared_ptr<State>& parent, const GeoReference& place,
                                      DatasetPtr dataset) {
    return std::make_shared<State>(State{parent, parent->kind, place, parent->blame, std::move(dataset)});
  }

  template <typename T>
  Array2d<T> read(const Window& w) const {
    constexpr bool kIsColor = sizeof(T) == sizeof(Rgba8) && !std::is_floating_point_v<T>;
    constexpr GDALDataType kType = std::is_floating_point_v<T> ? GDT_Float32 : GDT_Byte;
    SKY_CHECK(w.column >= 0 && w.row >= 0 && w.column + w.width <= dataset->GetRasterXSize() &&
              w.row + w.height <= dataset->GetRasterYSize());
    const GdalSession gdal;
    Array2d<T> out(w.width, w.height);
    const CPLErr error =
        dataset->RasterIO(GF_Read, w.column, w.row, w.width, w.height, out.data(), w.width, w.height, kType,
                          kIsColor ? 4 : 1, nullptr, sizeof(T), static_cast<GSpacing>(sizeof(T)) * w.width, 1, nullptr);
    if (error == CE_None && gdal.first_error().empty()) return out;
    blame();
    throw bad_input("the map cannot be read: " + gdal.reason("GDAL gives no reason"));
  }
};

VirtualRaster VirtualRaster::mosaic(const Cog& cog) {
  SKY_CHECK(cog.width > 0 && cog.height > 0);
  const GdalSession gdal;
  return VirtualRaster(std::make_shared<State>(
      State{nullptr, cog.kind, cog.georeference, [cog] { blame_a_source(cog); }, mosaic_dataset(cog)}));
}

CogKind VirtualRaster::kind() const { return state_->kind; }
int VirtualRaster::width() const { return state_->dataset->GetRasterXSize(); }
int VirtualRaster::height() const { return state_->dataset->GetRasterYSize(); }

VirtualRaster VirtualRaster::resampled(const Resample& to) const {
  SKY_CHECK(to.width > 0 && to.height > 0 && to.scale > 0);
  SKY_CHECK(kind() != CogKind::classes || to.method == Resampling::nearest);
  const GdalSession gdal;
  std::vector<std::string> arguments = warp_arguments(kind(), to);
  const std::string from_crs = horizontal_wkt(state_->georeference.crs_wkt);
  const std::string to_crs = horizontal_wkt(to.georeference.crs_wkt);
  if (from_crs != to_crs) arguments.insert(arguments.end(), {"-s_srs", from_crs, "-t_srs", to_crs});
  return VirtualRaster(State::child(state_, to.georeference, warped(*state_->dataset, arguments, gdal)));
}

VirtualRaster VirtualRaster::window(const Window& w) const {
  SKY_CHECK(w.column >= 0 && w.row >= 0 && w.width > 0 && w.height > 0 && w.column + w.width <= width() &&
            w.row + w.height <= height());
  const GdalSession gdal;
  const std::vector<std::string> words = {"-of",
                                          "VRT",
                                          "-srcwin",
                                          std::to_string(w.column),
                                          std::to_string(w.row),
                                          std::to_string(w.width),
                                          std::to_string(w.height)};
  const std::unique_ptr<GDALTranslateOptions, decltype(&GDALTranslateOptionsFree)> options(
      GDALTranslateOptionsNew(list_of(words).List(), nullptr), GDALTranslateOptionsFree);
  DatasetPtr part(
      GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(state_->dataset.get()), options.get(), nullptr)));
  if (!part) throw failure("the map cannot be cut: " + gdal.reason("GDAL gives no reason"));
  GeoReference place = state_->georeference;
  place.north_west_corner.x += w.column * place.cell_m;
  place.north_west_corner.y -= w.row * place.cell_m;
  return VirtualRaster(State::child(state_, place, std::move(part)));
}

VirtualRaster VirtualRaster::with_no_data(double value) const {
  SKY_CHECK(type_of(kind()) == GDT_Float32);
  const GdalSession gdal;
  const Resample same{state_->georeference, width(), height(), Resampling::nearest, 1};
  return VirtualRaster(
      State::child(state_, state_->georeference, warped(*state_->dataset, warp_arguments(kind(), same, value), gdal)));
}

Array2d<float> VirtualRaster::floats(const Window& window) const {
  SKY_CHECK(type_of(kind()) == GDT_Float32);
  return state_->read<float>(window);
}

Array2d<Rgba8> VirtualRaster::colors(const Window& window) const {
  SKY_CHECK(kind() == CogKind::colors);
  return state_->read<Rgba8>(window);
}

Array2d<std::uint8_t> VirtualRaster::classes(const Window& window) const {
  SKY_CHECK(kind() == CogKind::classes);
  return state_->read<std::uint8_t>(window);
}

void VirtualRaster::write(const fs::path& path, const std::string& driver_name, const std::vector<std::string>& options,
                          const Labels& labels, const fs::path& blamed, const OnProgress& progress) const {
  const GdalSession gdal;
  GDALDataset& dataset = *state_->dataset;
  // With the vertical part of the reference system, which resampling leaves out.
  put_georeference(dataset, state_->georeference);
  put_labels(dataset, labels);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name.c_str());
  SKY_CHECK(driver != nullptr);
  bool stopped = false;
  const OnProgress watched = [&](double share) {
    stopped = stopped || (progress && !progress(share));
    return !stopped;
  };
  DatasetPtr written(driver->CreateCopy(path.c_str(), &dataset, FALSE, list_of(options).List(), &tell_progress,
                                        const_cast<OnProgress*>(&watched)));
  const bool complete = written != nullptr;
  written.reset();  // writes the last blocks; what goes wrong then is known only to the session
  if (stopped) throw Stopped{};
  if (complete && gdal.first_error().empty()) return;
  state_->blame();
  throw failure("cannot write " + blamed.string() + ": " + gdal.reason("GDAL gives no reason"));
}

}  // namespace skysweep::raster
