// SPDX-License-Identifier: Apache-2.0
#include "formats/gcp_list.h"

#include <algorithm>

#include "core/error.h"
#include "formats/text/line_reader.h"
#include "formats/text/numbers.h"
#include "formats/text/text_file.h"

namespace skysweep::formats {
namespace {

constexpr Vec2d kPixelCenter{0.5, 0.5};

void require_one_word(const std::string& path, const std::string& name) {
  if (words(name).size() != 1 || words(name)[0] != name)
    throw bad_input(path + ": a list of ground control points cannot hold the name '" + name +
                    "' (empty or with spaces); rename it.");
}

double number(std::string_view word, const std::string& where) {
  if (const auto value = parse_number(word)) return *value;
  throw bad_input(where + ": '" + std::string(word) + "' is not a finite number.");
}

GroundControlPoint& point_of(GcpList& list, const std::string& name, Vec3d position) {
  const auto same = [&](const GroundControlPoint& p) { return p.name == name && p.position == position; };
  const auto found = std::find_if(list.points.begin(), list.points.end(), same);
  if (found != list.points.end()) return *found;
  return list.points.emplace_back(GroundControlPoint{name, position, {}});
}

}  // namespace

void write_gcp_list(const std::string& path, const GcpList& list) {
  std::string text = list.crs + "\n";
  for (const GroundControlPoint& point : list.points) {
    require_one_word(path, point.name);
    for (const GroundControlPoint::Sighting& sighting : point.sightings) {
      require_one_word(path, sighting.image);
      const Vec3d p = point.position;
      const Vec2d pixel = sighting.pixel - kPixelCenter;
      for (const double value : {p.x, p.y, p.z, pixel.x, pixel.y}) text += exact_text(value) + ' ';
      text += sighting.image + ' ' + point.name + '\n';
    }
  }
  write_text_file(path, text);
}

GcpList read_gcp_list(const std::string& path) {
  LineReader reader(path);
  GcpList list;
  while (reader.next()) {
    if (is_blank_or_comment(reader.line())) continue;
    if (list.crs.empty()) {
      list.crs = trimmed(reader.line());
      continue;
    }
    const auto w = words(reader.line());
    const std::string where = reader.where();
    if (w.size() < 6)
      throw bad_input(where + ": a ground control point reads X Y Z PIXEL_X PIXEL_Y IMAGE [NAME]; this line has " +
                      std::to_string(w.size()) + " words.");
    const Vec3d position{number(w[0], where), number(w[1], where), number(w[2], where)};
    GroundControlPoint& point = point_of(list, w.size() > 6 ? std::string(w[6]) : "", position);
    point.sightings.push_back({std::string(w[5]), Vec2d{number(w[3], where), number(w[4], where)} + kPixelCenter});
  }
  if (list.crs.empty()) throw bad_input(path + ": the first line has to name the reference system.");
  return list;
}

}  // namespace skysweep::formats
