// SPDX-License-Identifier: Apache-2.0
// cameras.txt, images.txt and points3D.txt.
#include "core/error.h"
#include "formats/colmap/records.h"
#include "formats/text/line_reader.h"
#include "formats/text/numbers.h"

namespace skysweep::formats::colmap {
namespace {

using Words = std::vector<std::string_view>;

double number(std::string_view word, const std::string& where) {
  if (const auto value = parse_number(word)) return *value;
  throw bad_input(where + ": '" + std::string(word) + "' is not a finite number.");
}

std::uint64_t count(std::string_view word, const std::string& where) {
  if (const auto value = parse_count(word)) return *value;
  throw bad_input(where + ": '" + std::string(word) + "' is not a whole number.");
}

std::uint32_t identifier(std::string_view word, const std::string& where) {
  const std::uint64_t value = count(word, where);
  if (value > UINT32_MAX) throw bad_input(where + ": the identifier " + std::string(word) + " is too large.");
  return static_cast<std::uint32_t>(value);
}

// The image's name is the rest of its line after nine words, inner spaces included.
std::string name_after(const std::string& line, std::string_view last_word_before) {
  const std::size_t at = static_cast<std::size_t>(last_word_before.data() + last_word_before.size() - line.data());
  return std::string(trimmed(std::string_view(line).substr(at)));
}

// Whether a line can be the observations of an image: x, y, point id, and so on; blank if there are none.
bool is_observations(const Words& line_words) {
  return line_words.size() % 3 == 0 && (line_words.empty() || (parse_number(line_words.back()).has_value() &&
                                                               parse_number(line_words.front()).has_value()));
}

}  // namespace

std::vector<CameraRecord> read_cameras_text(const std::string& path) {
  std::vector<CameraRecord> cameras;
  LineReader reader(path);
  while (reader.next()) {
    if (is_blank_or_comment(reader.line())) continue;
    const Words w = words(reader.line());
    const std::string where = reader.where();
    if (w.size() < 5)
      throw bad_input(where + ": a camera line reads CAMERA_ID MODEL WIDTH HEIGHT PARAMETERS; this one ends early.");
    CameraRecord camera;
    camera.id = identifier(w[0], where);
    camera.model = w[1];
    camera.where = where;
    try {
      camera.width_px = count(w[2], where);
      camera.height_px = count(w[3], where);
      for (std::size_t i = 4; i < w.size(); ++i) camera.parameters.push_back(number(w[i], where));
    } catch (const Error& error) {
      camera.problem = error.what();
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

std::vector<ImageRecord> read_images_text(const std::string& path) {
  std::vector<ImageRecord> images;
  LineReader reader(path);
  while (reader.next()) {
    if (is_blank_or_comment(reader.line())) continue;
    const Words w = words(reader.line());
    ImageRecord image;
    image.where = reader.where();
    if (w.size() < 10)
      throw bad_input(image.where +
                      ": an image line reads IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME; this one has " +
                      std::to_string(w.size()) + " words.");
    image.name = name_after(reader.line(), w[8]);
    try {
      for (std::size_t i = 0; i < 4; ++i) image.cam_from_world_wxyz[i] = number(w[1 + i], image.where);
      image.translation = {number(w[5], image.where), number(w[6], image.where), number(w[7], image.where)};
      image.camera_id = identifier(w[8], image.where);
    } catch (const Error& error) {
      image.problem = error.what();
    }
    if (reader.next() && !is_observations(words(reader.line())))
      throw bad_input(reader.where() + ": the observations of image '" + image.name +
                      "' are expected here; every image takes two lines, of which the second may be empty.");
    images.push_back(std::move(image));
  }
  return images;
}

void read_points_text(const std::string& path, const std::function<void(const PointRecord&)>& visit) {
  LineReader reader(path);
  while (reader.next()) {
    if (is_blank_or_comment(reader.line())) continue;
    const Words w = words(reader.line());
    const std::string where = reader.where();
    if (w.size() < 8 || w.size() % 2 != 0)
      throw bad_input(where +
                      ": a point line reads POINT3D_ID X Y Z R G B ERROR and pairs of IMAGE_ID POINT2D_IDX; "
                      "this one has " +
                      std::to_string(w.size()) + " words.");
    visit({count(w[0], where),
           {number(w[1], where), number(w[2], where), number(w[3], where)},
           number(w[7], where),
           (w.size() - 8) / 2});
  }
}

}  // namespace skysweep::formats::colmap
