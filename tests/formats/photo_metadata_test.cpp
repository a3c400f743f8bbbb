// SPDX-License-Identifier: Apache-2.0
// Read back with Exiv2 alone, as any other program would.
#include "formats/photo_metadata.h"

#include <gtest/gtest.h>

#include <exiv2/exiv2.hpp>
#include <string>

#include "core/error.h"

namespace skysweep::formats {
namespace {

// A grey PNG of one pixel.
std::string tiny_png() {
  const unsigned char bytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                                 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00,
                                 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00, 0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78,
                                 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81, 0x77, 0xcd, 0x72, 0xb6, 0x00,
                                 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

PhotoMetadata some_metadata() {
  PhotoMetadata m;
  m.make = "Maker";
  m.model = "X1";
  m.software = "skysweep 1";
  m.taken = std::chrono::sys_days{std::chrono::year{2026} / 6 / 21} + std::chrono::hours(23) +
            std::chrono::minutes(59) + std::chrono::milliseconds(58007);
  m.width_px = 4000;
  m.height_px = 3000;
  m.focal_mm = 8.8;
  m.sensor_width_mm = 13.2;
  m.position = {48.123456789, -11.987654321};
  m.altitude_m = 571.25;
  m.relative_altitude_m = 60;
  m.gimbal_yaw_deg = -170.5;
  m.gimbal_pitch_deg = -89.5;
  m.gimbal_roll_deg = 0.25;
  return m;
}

struct Tags {
  Exiv2::ExifData exif;
  Exiv2::XmpData xmp;
  std::string text(const std::string& key) { return exif[key].toString(); }
  double number(const std::string& key, long i = 0) {
    const Exiv2::Rational r = exif[key].toRational(i);
    return static_cast<double>(static_cast<std::uint32_t>(r.first)) / static_cast<std::uint32_t>(r.second);
  }
  double angle(const std::string& key) { return number(key, 0) + number(key, 1) / 60 + number(key, 2) / 3600; }
  bool has(const std::string& key) { return exif.findKey(Exiv2::ExifKey(key)) != exif.end(); }
};

Tags tags_of(const std::string& file) {
  const auto image =
      Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(file.data()), static_cast<long>(file.size()));
  image->readMetadata();
  return {image->exifData(), image->xmpData()};
}

TEST(PhotoMetadataTags, name_camera_and_sensor) {
  Tags tags = tags_of(with_metadata(tiny_png(), some_metadata()));
  EXPECT_EQ(tags.text("Exif.Image.Make"), "Maker");
  EXPECT_EQ(tags.text("Exif.Image.Model"), "X1");
  EXPECT_EQ(tags.text("Exif.Image.Software"), "skysweep 1");
  EXPECT_NEAR(tags.number("Exif.Photo.FocalLength"), 8.8, 1e-4);
  EXPECT_EQ(tags.text("Exif.Photo.FocalLengthIn35mmFilm"), "23");  // 8.8 x 43.27 / 16.5
  EXPECT_EQ(tags.text("Exif.Photo.FocalPlaneResolutionUnit"), "3");
  EXPECT_NEAR(4000 / tags.number("Exif.Photo.FocalPlaneXResolution") * 10, 13.2, 1e-5);
  EXPECT_EQ(tags.text("Exif.Photo.PixelYDimension"), "3000");
}

TEST(PhotoMetadataTags, tell_the_time_to_the_millisecond) {
  Tags tags = tags_of(with_metadata(tiny_png(), some_metadata()));
  EXPECT_EQ(tags.text("Exif.Photo.DateTimeOriginal"), "2026:06:21 23:59:58");
  EXPECT_EQ(tags.text("Exif.Photo.SubSecTimeOriginal"), "007");
  EXPECT_EQ(tags.text("Exif.Photo.OffsetTimeOriginal"), "+00:00");
}

TEST(PhotoMetadataTags, tell_the_position_to_a_tenth_of_a_millimetre) {
  Tags tags = tags_of(with_metadata(tiny_png(), some_metadata()));
  EXPECT_EQ(tags.text("Exif.GPSInfo.GPSLatitudeRef"), "N");
  EXPECT_EQ(tags.text("Exif.GPSInfo.GPSLongitudeRef"), "W");
  EXPECT_NEAR(tags.angle("Exif.GPSInfo.GPSLatitude"), 48.123456789, 1e-9);
  EXPECT_NEAR(tags.angle("Exif.GPSInfo.GPSLongitude"), 11.987654321, 1e-9);
  EXPECT_NEAR(tags.number("Exif.GPSInfo.GPSAltitude"), 571.25, 1e-9);
  EXPECT_EQ(tags.text("Exif.GPSInfo.GPSAltitudeRef"), "0");
  EXPECT_EQ(tags.text("Exif.GPSInfo.GPSMapDatum"), "WGS-84");
}

TEST(PhotoMetadataTags, below_the_vertical_datum_have_another_reference) {
  PhotoMetadata m = some_metadata();
  m.altitude_m = -3.5;
  Tags tags = tags_of(with_metadata(tiny_png(), m));
  EXPECT_EQ(tags.text("Exif.GPSInfo.GPSAltitudeRef"), "1");
  EXPECT_NEAR(tags.number("Exif.GPSInfo.GPSAltitude"), 3.5, 1e-9);
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.AbsoluteAltitude"].toString(), "-3.500");
}

TEST(PhotoMetadataTags, hold_the_gimbal_as_dji_writes_it) {
  Tags tags = tags_of(with_metadata(tiny_png(), some_metadata()));
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.GimbalYawDegree"].toString(), "-170.50");
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.GimbalPitchDegree"].toString(), "-89.50");
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.GimbalRollDegree"].toString(), "+0.25");
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.RelativeAltitude"].toString(), "+60.000");
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.AbsoluteAltitude"].toString(), "+571.250");
  EXPECT_EQ(tags.xmp["Xmp.drone-dji.GpsLongitude"].toString(), "-11.9876543210");
}

TEST(PhotoMetadataTags, without_a_position_have_no_gps) {
  PhotoMetadata m = some_metadata();
  m.position.reset();
  Tags tags = tags_of(with_metadata(tiny_png(), m));
  EXPECT_FALSE(tags.has("Exif.GPSInfo.GPSLatitude"));
  EXPECT_FALSE(tags.has("Exif.GPSInfo.GPSAltitude"));
  EXPECT_EQ(tags.xmp.findKey(Exiv2::XmpKey("Xmp.drone-dji.GpsLatitude")), tags.xmp.end());
  EXPECT_TRUE(tags.has("Exif.Photo.FocalLength"));
}

TEST(PhotoMetadataTags, go_into_images_only) { EXPECT_THROW(with_metadata("no image", some_metadata()), Error); }

}  // namespace
}  // namespace skysweep::formats
