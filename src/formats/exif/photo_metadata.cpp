// SPDX-License-Identifier: Apache-2.0
#include "formats/photo_metadata.h"

#include <cmath>
#include <cstdio>
#include <exiv2/exiv2.hpp>
#include <mutex>

#include "core/error.h"

namespace skysweep::formats {
namespace {

using Exiv2::Rational;
using Exiv2::URational;

std::string formatted(const char* format, auto... values) {
  char text[96];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

URational fraction(double value, unsigned denominator) {
  return {static_cast<std::uint32_t>(std::llround(value * denominator)), denominator};
}

void put_rational(Exiv2::ExifData& exif, const char* key, URational value) { exif[key] = value; }

// Degrees, minutes and seconds of an angle's absolute value.
Exiv2::URationalValue::AutoPtr degrees_minutes_seconds(double angle_deg) {
  constexpr long long kPerSecond = 1000000;
  const long long total = std::llround(std::abs(angle_deg) * 3600 * kPerSecond);
  auto value = std::make_unique<Exiv2::URationalValue>();
  value->value_ = {{static_cast<std::uint32_t>(total / (3600 * kPerSecond)), 1},
                   {static_cast<std::uint32_t>(total / (60 * kPerSecond) % 60), 1},
                   {static_cast<std::uint32_t>(total % (60 * kPerSecond)), static_cast<std::uint32_t>(kPerSecond)}};
  return Exiv2::URationalValue::AutoPtr(value.release());
}

struct CivilTime {
  int year;
  unsigned month, day;
  int hour, minute, second, millisecond;
};

CivilTime civil(std::chrono::sys_time<std::chrono::milliseconds> time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  return {static_cast<int>(date.year()),
          static_cast<unsigned>(date.month()),
          static_cast<unsigned>(date.day()),
          static_cast<int>(clock.hours().count()),
          static_cast<int>(clock.minutes().count()),
          static_cast<int>(clock.seconds().count()),
          static_cast<int>(clock.subseconds().count())};
}

void put_camera(const PhotoMetadata& m, Exiv2::ExifData& exif) {
  exif["Exif.Image.Make"] = m.make;
  exif["Exif.Image.Model"] = m.model;
  exif["Exif.Image.Software"] = m.software;
  exif["Exif.Photo.PixelXDimension"] = static_cast<std::uint32_t>(m.width_px);
  exif["Exif.Photo.PixelYDimension"] = static_cast<std::uint32_t>(m.height_px);
  put_rational(exif, "Exif.Photo.FocalLength", fraction(m.focal_mm, 10000));
  constexpr double kDiagonalOf35mmFilm = 43.2666;
  const double sensor_height_mm = m.sensor_width_mm * m.height_px / m.width_px;
  const double equivalent_mm = m.focal_mm * kDiagonalOf35mmFilm / std::hypot(m.sensor_width_mm, sensor_height_mm);
  exif["Exif.Photo.FocalLengthIn35mmFilm"] = static_cast<std::uint16_t>(std::lround(equivalent_mm));
  const URational pixels_per_cm = fraction(10 * m.width_px / m.sensor_width_mm, 1000);
  constexpr std::uint16_t kCentimetre = 3;
  put_rational(exif, "Exif.Photo.FocalPlaneXResolution", pixels_per_cm);
  put_rational(exif, "Exif.Photo.FocalPlaneYResolution", pixels_per_cm);
  exif["Exif.Photo.FocalPlaneResolutionUnit"] = kCentimetre;
}

void put_time(const PhotoMetadata& m, Exiv2::ExifData& exif) {
  const CivilTime t = civil(m.taken);
  const std::string text =
      formatted("%04d:%02u:%02u %02d:%02d:%02d", t.year, t.month, t.day, t.hour, t.minute, t.second);
  exif["Exif.Image.DateTime"] = text;
  exif["Exif.Photo.DateTimeOriginal"] = text;
  exif["Exif.Photo.SubSecTimeOriginal"] = formatted("%03d", t.millisecond);
  exif["Exif.Photo.OffsetTimeOriginal"] = std::string("+00:00");
}

void put_position(const PhotoMetadata& m, Exiv2::ExifData& exif) {
  const GeoPosition p = *m.position;
  exif["Exif.GPSInfo.GPSVersionID"] = std::string("2 3 0 0");
  exif["Exif.GPSInfo.GPSMapDatum"] = std::string("WGS-84");
  exif["Exif.GPSInfo.GPSLatitudeRef"] = std::string(p.latitude_deg < 0 ? "S" : "N");
  exif["Exif.GPSInfo.GPSLatitude"] = *degrees_minutes_seconds(p.latitude_deg);
  exif["Exif.GPSInfo.GPSLongitudeRef"] = std::string(p.longitude_deg < 0 ? "W" : "E");
  exif["Exif.GPSInfo.GPSLongitude"] = *degrees_minutes_seconds(p.longitude_deg);
  auto below = Exiv2::Value::create(Exiv2::unsignedByte);
  below->read(m.altitude_m < 0 ? "1" : "0");
  exif.add(Exiv2::ExifKey("Exif.GPSInfo.GPSAltitudeRef"), below.get());
  put_rational(exif, "Exif.GPSInfo.GPSAltitude", fraction(std::abs(m.altitude_m), 1000));
}

void put_dji(const PhotoMetadata& m, Exiv2::XmpData& xmp) {
  const auto put = [&](const char* name, const std::string& text) { xmp["Xmp.drone-dji." + std::string(name)] = text; };
  put("AbsoluteAltitude", formatted("%+.3f", m.altitude_m));
  put("RelativeAltitude", formatted("%+.3f", m.relative_altitude_m));
  put("GimbalYawDegree", formatted("%+.2f", m.gimbal_yaw_deg));
  put("GimbalPitchDegree", formatted("%+.2f", m.gimbal_pitch_deg));
  put("GimbalRollDegree", formatted("%+.2f", m.gimbal_roll_deg));
  if (!m.position) return;
  put("GpsLatitude", formatted("%+.10f", m.position->latitude_deg));
  put("GpsLongitude", formatted("%+.10f", m.position->longitude_deg));
}

// Exiv2's XMP parser is started once, before threads use it, and learns the maker's name space.
void prepare_xmp() {
  static std::once_flag once;
  std::call_once(once, [] {
    Exiv2::XmpParser::initialize();
    Exiv2::XmpProperties::registerNs("http://www.dji.com/drone-dji/1.0/", "drone-dji");
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
  });
}

}  // namespace

std::string with_metadata(const std::string& image_file, const PhotoMetadata& metadata) {
  prepare_xmp();
  try {
    const auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(image_file.data()),
                                                 static_cast<long>(image_file.size()));
    image->readMetadata();
    put_camera(metadata, image->exifData());
    put_time(metadata, image->exifData());
    if (metadata.position) put_position(metadata, image->exifData());
    put_dji(metadata, image->xmpData());
    image->writeMetadata();
    Exiv2::BasicIo& io = image->io();
    io.open();
    std::string out(static_cast<std::size_t>(io.size()), '\0');
    io.read(reinterpret_cast<Exiv2::byte*>(out.data()), static_cast<long>(out.size()));
    io.close();
    return out;
  } catch (const Exiv2::Error& error) {
    throw failure(std::string("metadata cannot be written into a photograph: ") + error.what());
  }
}

}  // namespace skysweep::formats
