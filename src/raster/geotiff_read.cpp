// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "raster/gdal/labels.h"
#include "raster/gdal/session.h"
#include "raster/geotiff.h"

namespace skysweep::raster {

namespace {

namespace fs = std::filesystem;

Error refused(const fs::path& path, const std::string& why) { return bad_input(path.string() + " " + why); }

// One raster file while it is read. Every failure becomes an Error that names the file.
class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw refused(path, "does not exist");
    dataset_.reset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
    if (!dataset_ || bands() == 0)
      throw refused(path, "is not a raster that can be read: " + gdal_.reason("GDAL knows no format for it"));
  }

  int width() const { return dataset_->GetRasterXSize(); }
  int height() const { return dataset_->GetRasterYSize(); }
  int bands() const { return dataset_->GetRasterCount(); }
  GDALRasterBand& band(int number) const { return *dataset_->GetRasterBand(number); }
  GDALDataType type() const { return band(1).GetRasterDataType(); }
  bool is_alpha(int number) const {
    return number <= bands() && band(number).GetColorInterpretation() == GCI_AlphaBand;
  }
  // Bands that are not alpha.
  int value_bands() const {
    int count = 0;
    for (int number = 1; number <= bands(); ++number) count += is_alpha(number) ? 0 : 1;
    return count;
  }

  // All of a band (or mask) into memory where values lie `stride` bytes apart.
  void read(GDALRasterBand& source, void* to, GDALDataType type, int stride) const {
    const CPLErr result = source.RasterIO(GF_Read, 0, 0, width(), height(), to, width(), height(), type, stride,
                                          static_cast<GSpacing>(stride) * width(), nullptr);
    if (result != CE_None || !gdal_.first_error().empty())
      throw refused(path_, "is damaged: " + gdal_.reason("reading its values failed"));
  }

  // 0 where the band has no data: by no-data value, mask band or alpha band.
  Array2d<std::uint8_t> mask_of(int number) const {
    Array2d<std::uint8_t> mask(width(), height(), 255);
    if ((band(number).GetMaskFlags() & GMF_ALL_VALID) == 0) read(*band(number).GetMaskBand(), mask.data(), GDT_Byte, 1);
    return mask;
  }

  template <typename T>
  Raster<T> finish(Array2d<T> values) const {
    std::string problem;
    std::optional<GeoReference> georeference = georeference_of(*dataset_, problem);
    if (!georeference) throw refused(path_, problem);
    return {std::move(values), std::move(*georeference), labels()};
  }

  Labels labels() const { return labels_of(*dataset_); }

  void require(bool condition, const std::string& why) const {
    if (!condition) throw refused(path_, why);
  }

 private:
  fs::path path_;
  GdalSession gdal_;
  DatasetPtr dataset_;
};

std::string band_count(const Reader& file) { return std::to_string(file.value_bands()) + " bands"; }

}  // namespace

Raster<float> read_float_raster(const fs::path& path) {
  const Reader file(path);
  file.require(file.value_bands() == 1,
               "has " + band_count(file) + ", but one band of numbers is needed: choose it with gdal_translate -b");
  file.require(!GDALDataTypeIsComplex(file.type()), "holds complex numbers, but real ones are needed");
  Array2d<float> values(file.width(), file.height());
  file.read(file.band(1), values.data(), GDT_Float32, sizeof(float));
  const Array2d<std::uint8_t> mask = file.mask_of(1);
  const double scale = file.band(1).GetScale(), offset = file.band(1).GetOffset();
  if (scale != 1 || offset != 0)
    for (float& value : values) value = static_cast<float>(value * scale + offset);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (mask.data()[i] == 0) values.data()[i] = std::numeric_limits<float>::quiet_NaN();
  return file.finish(std::move(values));
}

Raster<Rgba8> read_color_raster(const fs::path& path) {
  const Reader file(path);
  file.require(file.type() == GDT_Byte,
               "has colours that are not 8 bits deep: convert it with gdal_translate -ot Byte -scale");
  file.require(file.band(1).GetColorTable() == nullptr,
               "has a colour table: convert it with gdal_translate -expand rgb");
  const int colors = file.value_bands();
  file.require(colors == 1 || colors >= 3, "has " + band_count(file) + ", but a colour image has one, three or four");

  Array2d<Rgba8> values(file.width(), file.height());
  auto* bytes = reinterpret_cast<std::uint8_t*>(values.data());
  for (int channel = 0; channel < 3; ++channel)
    file.read(file.band(colors == 1 ? 1 : channel + 1), bytes + channel, GDT_Byte, sizeof(Rgba8));
  // A colour is unknown only where all its bands say so: a pure red has the no-data value 0 in two of them.
  for (int channel = 0; channel < (colors == 1 ? 1 : 3); ++channel) {
    const Array2d<std::uint8_t> mask = file.mask_of(channel + 1);
    for (std::size_t i = 0; i < values.size(); ++i) values.data()[i].a = std::max(values.data()[i].a, mask.data()[i]);
  }
  return file.finish(std::move(values));
}

Raster<std::uint8_t> read_class_raster(const fs::path& path) {
  const Reader file(path);
  file.require(file.value_bands() == 1 && file.type() == GDT_Byte,
               "is not a raster of classes: one band of 8-bit numbers is needed");
  Array2d<std::uint8_t> values(file.width(), file.height());
  file.read(file.band(1), values.data(), GDT_Byte, 1);
  const Array2d<std::uint8_t> mask = file.mask_of(1);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (mask.data()[i] == 0) values.data()[i] = 0;
  return file.finish(std::move(values));
}

Labels read_labels(const fs::path& path) { return Reader(path).labels(); }

}  // namespace skysweep::raster
