// SPDX-License-Identifier: Apache-2.0
// What a drone writes into a photograph beside the pixels: EXIF tags and the XMP tags of DJI (through Exiv2).
//
// Conventions, as far as the makers' own are known (EXIF 2.31; DJI's XMP name space drone-dji 1.0):
//   position         GPSLatitude and so on: WGS 84, to a millionth of a second of arc (30 micrometres); no position, no
//                    GPS tags at all
//   GPSAltitude      the height of the camera in the vertical reference of the poses, whatever that is: EXIF has no tag
//                    that would say it; to a millimetre
//   AbsoluteAltitude the same; RelativeAltitude: above the place of take-off
//   Gimbal...Degree  yaw clockwise from grid north, pitch above the horizon (-90 looks straight down), roll clockwise
//                    about the view direction: camera::rotation_from_yaw_pitch_roll; to a hundredth of a degree
//   time             DateTimeOriginal with SubSecTimeOriginal (milliseconds) in UTC, which OffsetTimeOriginal says
//   sensor           FocalLength in millimetres, FocalLengthIn35mmFilm by the diagonal, FocalPlaneXResolution in
//                    pixels per centimetre: sensor width = PixelXDimension / FocalPlaneXResolution
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace skysweep::formats {

struct GeoPosition {
  double latitude_deg = 0, longitude_deg = 0;  // WGS 84; north and east positive
};

struct PhotoMetadata {
  std::string make, model, software;
  std::chrono::sys_time<std::chrono::milliseconds> taken;  // UTC
  int width_px = 0, height_px = 0;
  double focal_mm = 0;
  double sensor_width_mm = 0;
  std::optional<GeoPosition> position;
  double altitude_m = 0;
  double relative_altitude_m = 0;
  double gimbal_yaw_deg = 0, gimbal_pitch_deg = 0, gimbal_roll_deg = 0;
};

// The bytes of a JPEG, PNG or TIFF file with the tags; the pixels stay as they are. Throws Error(failed) if the bytes
// are no such file. Not to be called by two threads at once.
std::string with_metadata(const std::string& image_file, const PhotoMetadata& metadata);

}  // namespace skysweep::formats
