// SPDX-License-Identifier: Apache-2.0
#include "formats/time_taken.h"

#include <cstdio>
#include <exiv2/exiv2.hpp>
#include <string>

namespace skysweep::formats {
namespace {

using Milliseconds = std::chrono::milliseconds;
using Time = std::chrono::sys_time<Milliseconds>;

std::string text_of(const Exiv2::ExifData& exif, const char* key) {
  const auto found = exif.findKey(Exiv2::ExifKey(key));
  return found == exif.end() ? std::string() : found->toString();
}

// "2026:11:23 07:15:00"
std::optional<Time> parsed_time(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  if (std::sscanf(text.c_str(), "%d:%d:%d %d:%d:%d", &year, &month, &day, &hour, &minute, &second) != 6)
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
         std::chrono::seconds(second);
}

// "045" is 45 ms, "5" is half a second.
Milliseconds parsed_fraction(std::string digits) {
  digits.resize(3, '0');
  int value = 0;
  return std::sscanf(digits.c_str(), "%3d", &value) == 1 ? Milliseconds(value) : Milliseconds(0);
}

// "+02:00": how far the clock is ahead of UTC.
std::chrono::minutes parsed_offset(const std::string& text) {
  char sign = '+';
  int hours = 0, minutes = 0;
  if (std::sscanf(text.c_str(), "%c%d:%d", &sign, &hours, &minutes) != 3) return std::chrono::minutes(0);
  return std::chrono::minutes((sign == '-' ? -1 : 1) * (60 * hours + minutes));
}

}  // namespace

std::optional<Time> time_taken(const std::filesystem::path& photo) {
  try {
    Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    const Exiv2::ExifData& exif = image->exifData();
    const std::optional<Time> clock = parsed_time(text_of(exif, "Exif.Photo.DateTimeOriginal"));
    if (!clock) return std::nullopt;
    const std::string fraction = text_of(exif, "Exif.Photo.SubSecTimeOriginal");
    return *clock + (fraction.empty() ? Milliseconds(0) : parsed_fraction(fraction)) -
           parsed_offset(text_of(exif, "Exif.Photo.OffsetTimeOriginal"));
  } catch (const Exiv2::Error&) {
    return std::nullopt;
  }
}

}  // namespace skysweep::formats
