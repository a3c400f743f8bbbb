// SPDX-License-Identifier: Apache-2.0
#include "raster/photo.h"

#include <array>
#include <fstream>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/check.h"
#include "core/error.h"
#include "raster/atomic_file.h"
#include "raster/gdal/session.h"
#include "raster/photo/integrity.h"
#include "raster/photo/kind.h"

namespace skysweep::raster {

namespace {

namespace fs = std::filesystem;

Error refused(const fs::path& path, const std::string& why) { return bad_input(path.string() + " " + why); }

// The first `at_most` bytes of a file.
std::string read_bytes(const fs::path& path, std::uint64_t at_most) {
  std::error_code error;
  if (!fs::exists(path, error)) throw refused(path, "does not exist");
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw refused(path, "is not a file that can be read: " + error.message());
  if (size == 0) throw refused(path, "is empty: copy it from the camera again");
  std::string bytes(std::min(size, at_most), '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw refused(path, "cannot be read: check its permissions and the disk");
  return bytes;
}

PhotoKind readable_kind(const fs::path& path, std::string_view first_bytes) {
  const PhotoKind kind = photo_kind(path, first_bytes);
  if (kind == PhotoKind::heif)
    throw refused(path, "is a HEIF image, which has to be converted first: heif-convert -q 95 IN.heic OUT.jpg");
  if (kind == PhotoKind::camera_raw)
    throw refused(path,
                  "is a raw camera file, which has to be developed first: darktable-cli IN OUT.tif, or dcraw -T IN");
  if (kind == PhotoKind::unknown)
    throw refused(path, "is not an image of a known kind: JPEG, PNG, TIFF, WebP and BMP can be read");
  return kind;
}

const char* gdal_driver(PhotoKind kind) {
  switch (kind) {
    case PhotoKind::jpeg: return "JPEG";
    case PhotoKind::png: return "PNG";
    case PhotoKind::webp: return "WEBP";
    case PhotoKind::bmp: return "BMP";
    default: return "GTiff";
  }
}

void keep_opencv_quiet() {
  static std::once_flag once;
  std::call_once(once, [] { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); });
}

// OpenCV's decoders; empty if they fail.
cv::Mat decode(const std::string& bytes) {
  keep_opencv_quiet();
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(encoded, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

std::uint8_t to_8_bits(std::uint8_t value) { return value; }
std::uint8_t to_8_bits(std::uint16_t value) { return static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u); }

template <typename Channel>
Array2d<Rgb8> rgb_from_bgr(const cv::Mat& image) {
  Array2d<Rgb8> out(image.cols, image.rows);
  for (int y = 0; y < image.rows; ++y) {
    const auto* bgr = image.ptr<Channel>(y);
    Rgb8* rgb = out.row(y);
    for (int x = 0; x < image.cols; ++x, bgr += 3) rgb[x] = {to_8_bits(bgr[2]), to_8_bits(bgr[1]), to_8_bits(bgr[0])};
  }
  return out;
}

}  // namespace

namespace {

// The whole file, with its end and a header that makes sense.
std::string read_whole_photo(const fs::path& path) {
  constexpr std::uint64_t kMaxBytes = 1ull << 30;  // no photograph is larger; OpenCV counts bytes in an int
  const std::string bytes = read_bytes(path, kMaxBytes);
  const PhotoKind kind = readable_kind(path, bytes);
  if ((kind == PhotoKind::jpeg && !jpeg_is_complete(bytes)) || (kind == PhotoKind::png && !png_is_complete(bytes)))
    throw refused(path, "is cut off before its end: copy it from the camera again");
  read_photo_size(path);  // refuses broken headers, about which OpenCV would print
  return bytes;
}

}  // namespace

void require_whole_photo(const fs::path& path) { read_whole_photo(path); }

Array2d<Rgb8> read_photo(const fs::path& path) {
  const cv::Mat image = decode(read_whole_photo(path));
  if (image.empty()) throw refused(path, "is damaged: it cannot be decoded");
  switch (image.type()) {
    case CV_8UC3: return rgb_from_bgr<std::uint8_t>(image);
    case CV_16UC3: return rgb_from_bgr<std::uint16_t>(image);
    default: throw refused(path, "has pixels that are neither 8 nor 16 bits deep: convert it to 8 bits");
  }
}

PhotoSize read_photo_size(const fs::path& path) {
  constexpr std::uint64_t kFirstBytes = 64;
  const PhotoKind kind = readable_kind(path, read_bytes(path, kFirstBytes));
  const GdalSession gdal;
  const char* const drivers[] = {gdal_driver(kind), nullptr};
  const DatasetPtr image(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers));
  if (!image) throw refused(path, "is damaged: " + gdal.reason("its header cannot be read"));
  return {image->GetRasterXSize(), image->GetRasterYSize()};
}

std::string encode_image(const fs::path& path, const Array2d<Rgb8>& image, int jpeg_quality) {
  SKY_CHECK(!image.empty());
  keep_opencv_quiet();
  cv::Mat bgr(image.height(), image.width(), CV_8UC3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb8 rgb = image(x, y);
      bgr.at<cv::Vec3b>(y, x) = {rgb.b, rgb.g, rgb.r};
    }
  std::vector<int> parameters;
  const std::string ending = ending_of(path);
  if (ending == "jpg" || ending == "jpeg") parameters = {cv::IMWRITE_JPEG_QUALITY, jpeg_quality};
  std::vector<unsigned char> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode("." + ending, bgr, bytes, parameters);
  } catch (const cv::Exception&) {
  }
  if (!encoded) throw usage_error("cannot write " + path.string() + ": let its name end in .png, .jpg or .tif");
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_image(const fs::path& path, const Array2d<Rgb8>& image, int jpeg_quality) {
  write_bytes_atomically(path, encode_image(path, image, jpeg_quality));
}

}  // namespace skysweep::raster
