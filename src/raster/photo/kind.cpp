// SPDX-License-Identifier: Apache-2.0
#include "raster/photo/kind.h"

#include <algorithm>
#include <array>

namespace skysweep::raster {

namespace {

using namespace std::string_view_literals;

constexpr std::array kReadable = {"jpg"sv, "jpeg"sv, "png"sv, "tif"sv, "tiff"sv, "webp"sv, "bmp"sv};
constexpr std::array kHeif = {"heic"sv, "heif"sv, "hif"sv, "avif"sv};
constexpr std::array kCameraRaw = {"dng"sv, "cr2"sv, "cr3"sv, "nef"sv, "nrw"sv, "arw"sv, "raf"sv, "rw2"sv,
                                   "orf"sv, "pef"sv, "srw"sv, "3fr"sv, "iiq"sv, "rwl"sv, "gpr"sv};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& list, std::string_view ending) {
  return std::find(list.begin(), list.end(), ending) != list.end();
}

}  // namespace

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

bool is_photo_ending(std::string_view ending) {
  return contains(kReadable, ending) || contains(kHeif, ending) || contains(kCameraRaw, ending);
}

PhotoKind photo_kind(const std::filesystem::path& path, std::string_view first_bytes) {
  const auto starts_with = [&](std::string_view magic) { return first_bytes.starts_with(magic); };
  if (starts_with("\xff\xd8\xff"sv)) return PhotoKind::jpeg;
  if (starts_with("\x89PNG\r\n\x1a\n"sv)) return PhotoKind::png;
  const std::string_view brand = first_bytes.size() >= 12 ? first_bytes.substr(8, 4) : ""sv;
  if (starts_with("RIFF"sv) && brand == "WEBP"sv) return PhotoKind::webp;
  if (starts_with("BM"sv)) return PhotoKind::bmp;
  // ISO base media files: Canon's CR3 and, under many brands, the HEIF family that telephones write (also as .jpg).
  if (!brand.empty() && first_bytes.substr(4, 4) == "ftyp"sv)
    return brand == "crx "sv ? PhotoKind::camera_raw : PhotoKind::heif;
  // Most raw formats are TIFF inside, with a small preview where a TIFF reader looks first.
  const std::string ending = ending_of(path);
  if (contains(kCameraRaw, ending)) return PhotoKind::camera_raw;
  if (contains(kHeif, ending)) return PhotoKind::heif;
  if (starts_with("II*\0"sv) || starts_with("MM\0*"sv) || starts_with("II+\0"sv) || starts_with("MM\0+"sv))
    return PhotoKind::tiff;
  return PhotoKind::unknown;
}

}  // namespace skysweep::raster
