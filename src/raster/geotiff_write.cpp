// SPDX-License-Identifier: Apache-2.0
// The file is made in memory and then written by ourselves: GDAL never meets the disk, so a full disk is seen where it
// happens and reported with its reason.
#include <atomic>
#include <limits>

#include "core/check.h"
#include "core/error.h"
#include "raster/atomic_file.h"
#include "raster/gdal/labels.h"
#include "raster/gdal/session.h"
#include "raster/geotiff.h"

namespace skysweep::raster {

namespace {

constexpr int kBlockCells = 256;

// A file in GDAL's memory that goes away with this object.
class MemoryFile {
 public:
  MemoryFile() {
    static std::atomic<unsigned long> counter{0};
    path_ = "/vsimem/skysweep-" + std::to_string(counter++) + ".tif";
  }
  ~MemoryFile() { VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  std::string_view bytes() const {
    vsi_l_offset size = 0;
    const GByte* data = VSIGetMemFileBuffer(path_.c_str(), &size, FALSE);
    return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)};
  }

 private:
  std::string path_;
};

// What differs between the kinds of rasters.
struct Kind {
  GDALDataType type;
  int bands;
  const char* predictor;  // 3: of floating-point numbers; 2: difference to the neighbour; 1: none
};
constexpr Kind kind_of(const float*) { return {GDT_Float32, 1, "PREDICTOR=3"}; }
constexpr Kind kind_of(const Rgba8*) { return {GDT_Byte, 4, "PREDICTOR=2"}; }
constexpr Kind kind_of(const std::uint8_t*) { return {GDT_Byte, 1, "PREDICTOR=1"}; }

CPLStringList creation_options(const Kind& kind, int width, int height) {
  CPLStringList options;
  // DEFLATE, because every reader knows it. Level 1: measured heights and colours are mostly noise in their last bits,
  // of which level 6 takes 2 to 4 % more away in almost twice the time.
  options.AddString("COMPRESS=DEFLATE");
  options.AddString("ZLEVEL=1");
  options.AddString(kind.predictor);
  options.AddString("BIGTIFF=IF_SAFER");
  if (width > kBlockCells || height > kBlockCells) {
    options.AddString("TILED=YES");
    options.SetNameValue("BLOCKXSIZE", std::to_string(kBlockCells).c_str());
    options.SetNameValue("BLOCKYSIZE", std::to_string(kBlockCells).c_str());
  }
  if (kind.bands == 4) {
    options.AddString("PHOTOMETRIC=RGB");
    options.AddString("ALPHA=NON-PREMULTIPLIED");
    options.AddString("INTERLEAVE=PIXEL");
  }
  return options;
}

void put_no_data(GDALRasterBand& band, const float*) { band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN()); }
void put_no_data(GDALRasterBand& band, const std::uint8_t*) { band.SetNoDataValue(0); }
void put_no_data(GDALRasterBand&, const Rgba8*) {}  // the alpha band tells

// Whether it worked; the session knows the reason if not.
template <typename T>
bool encode(const Raster<T>& raster, const std::string& memory_path) {
  constexpr Kind kind = kind_of(static_cast<const T*>(nullptr));
  const int width = raster.values.width(), height = raster.values.height();
  GDALDriver& driver = *GetGDALDriverManager()->GetDriverByName("GTiff");
  const DatasetPtr dataset(driver.Create(memory_path.c_str(), width, height, kind.bands, kind.type,
                                         creation_options(kind, width, height).List()));
  if (!dataset) return false;
  put_georeference(*dataset, raster.georeference);
  put_labels(*dataset, raster.labels);
  put_no_data(*dataset->GetRasterBand(1), raster.values.data());
  // GDAL's interface for reading and writing takes no const pointer; it only reads here.
  void* values = const_cast<T*>(raster.values.data());
  return dataset->RasterIO(GF_Write, 0, 0, width, height, values, width, height, kind.type, kind.bands, nullptr,
                           static_cast<GSpacing>(sizeof(T)), static_cast<GSpacing>(sizeof(T)) * width, 1,
                           nullptr) == CE_None;
}

// Gives the bytes of the file to `take`; `blamed` is named in the error.
template <typename T, typename Take>
void make(const Raster<T>& raster, const std::string& blamed, Take take) {
  SKY_CHECK(!raster.values.empty());
  GdalSession gdal;
  const MemoryFile memory;
  if (!encode(raster, memory.path()) || !gdal.first_error().empty())
    throw failure("cannot write " + blamed + ": " + gdal.reason("GDAL gives no reason"));
  take(memory.bytes());
}

template <typename T>
void write(const std::filesystem::path& path, const Raster<T>& raster) {
  make(raster, path.string(), [&](std::string_view bytes) { write_bytes_atomically(path, bytes); });
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const Raster<float>& raster) { write(path, raster); }
void write_geotiff(const std::filesystem::path& path, const Raster<Rgba8>& raster) { write(path, raster); }
void write_geotiff(const std::filesystem::path& path, const Raster<std::uint8_t>& raster) { write(path, raster); }

std::string geotiff_bytes(const Raster<float>& raster) {
  std::string out;
  make(raster, "a GeoTIFF", [&](std::string_view bytes) { out = bytes; });
  return out;
}

}  // namespace skysweep::raster
