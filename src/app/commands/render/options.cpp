// SPDX-License-Identifier: Apache-2.0
#include "app/commands/render/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "app/option_values.h"
#include "core/error.h"
#include "settings/nearest_word.h"

namespace skysweep::app {
namespace {

using render::Look;
using render::NamedView;

constexpr double kUsualFovDeg = 45;
constexpr int kLargestSidePx = 16384, kUsualSamples = 2, kMostSamples = 8;
const std::vector<std::string> kSurfaces = {"boxes", "bilinear"};
const std::vector<std::string> kBackends = {"auto", "cpu", "gpu"};

NamedView named_view(const std::string& word) {
  return static_cast<NamedView>(index_of_word(word, render::named_view_names(), "--view"));
}

// "1280x720".
render::PictureSize parse_size(const std::string& text) {
  render::PictureSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width_px);
  bool good = width.ec == std::errc() && width.ptr < end && *width.ptr == 'x';
  if (good) {
    const auto height = std::from_chars(width.ptr + 1, end, size.height_px);
    good = height.ec == std::errc() && height.ptr == end;
  }
  if (!good || size.width_px < 16 || size.height_px < 16 || size.width_px > kLargestSidePx ||
      size.height_px > kLargestSidePx)
    throw usage_error("--size takes WIDTHxHEIGHT in pixels, from 16 to " + std::to_string(kLargestSidePx) + ", not '" +
                      text + "'.");
  return size;
}

// "#e2e8ee" or "e2e8ee".
Rgb8 parse_color(const std::string& text) {
  const std::string digits = text.starts_with('#') ? text.substr(1) : text;
  unsigned value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [at, error] = std::from_chars(digits.data(), end, value, 16);
  if (error != std::errc() || at != end || digits.size() != 6)
    throw usage_error("--background takes a colour as RRGGBB in hexadecimal digits, not '" + text + "'.");
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
          static_cast<std::uint8_t>(value & 255)};
}

render::Sun parse_sun(const std::string& text) {
  const Vec2d v = parse_pair(text, "--sun", "AZIMUTH,ELEVATION in degrees");
  if (!(v.y > 0 && v.y <= 90)) throw usage_error("--sun takes an elevation above 0 and up to 90 degrees.");
  return {v.x, v.y};
}

bool has_scale(Look look) { return look != Look::orthophoto && look != Look::hillshade; }

void refuse(bool given, const std::string& option, const std::string& with) {
  if (given) throw usage_error(option + " has no effect with " + with + ": leave it away.");
}

const index::ImageRecord& photograph(const std::string& name, const std::vector<index::ImageRecord>& images) {
  std::vector<std::string> names;
  for (const index::ImageRecord& image : images) {
    if (image.name == name) {
      if (image.model.problem() || image.pose.problem())
        throw bad_input("the photograph " + name + " has no camera or no pose: " + image.reason);
      return image;
    }
    names.push_back(image.name);
  }
  const std::optional<std::string> nearest = settings::nearest_word(name, names);
  throw usage_error("--photo: the project has no photograph '" + name + "'" +
                    (nearest ? "; did you mean " + *nearest + "?" : "; `skysweep info` lists them."));
}

}  // namespace

PictureKind RenderOptions::kind() const {
  std::string ending = std::filesystem::path(output).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return PictureKind::png;
  if (ending == ".jpg" || ending == ".jpeg") return PictureKind::jpeg;
  if (ending == ".webp") return PictureKind::webp;
  if (ending == ".exr") return PictureKind::exr;
  throw usage_error("-o takes a file that ends in .png, .jpg, .webp or .exr, not '" + output + "'.");
}

int RenderOptions::quality_or_default() const {
  const int value = quality.value_or(90);
  if (value < 1 || value > 100) throw usage_error("--quality takes a number from 1 to 100.");
  return value;
}

render::LookOptions RenderOptions::look_options() const {
  render::LookOptions options;
  options.look = static_cast<Look>(index_of_word(look, render::look_names(), "--look"));
  if (sun) options.sun = parse_sun(*sun);
  options.shadows = shadows;
  if (background) options.background = parse_color(*background);
  if (relief_range) {
    const Vec2d range = parse_pair(*relief_range, "--relief-range", "LOW,HIGH in metres");
    if (!(range.x < range.y)) throw usage_error("--relief-range takes LOW,HIGH with LOW below HIGH.");
    options.relief_span_m = raster::HeightSpan{range.x, range.y};
  }
  options.legend = !no_legend;
  return options;
}

render::PictureOptions RenderOptions::picture_options() const {
  render::PictureOptions options;
  options.samples = samples.value_or(kUsualSamples);
  if (options.samples < 1 || options.samples > kMostSamples)
    throw usage_error("--samples takes a number from 1 to " + std::to_string(kMostSamples) +
                      ": its square is the number of rays a pixel.");
  options.level_of_detail = !exact;
  return options;
}

render::SurfaceForm RenderOptions::surface_form() const {
  return static_cast<render::SurfaceForm>(index_of_word(surface, kSurfaces, "--surface"));
}

RenderBackend RenderOptions::chosen_backend() const {
  return static_cast<RenderBackend>(index_of_word(backend, kBackends, "--backend"));
}

void RenderOptions::check() const {
  const PictureKind to = kind();
  const Look chosen = look_options().look;
  picture_options();
  surface_form();
  chosen_backend();
  quality_or_default();
  if (size) parse_size(*size);
  if (area) parse_area(*area);
  if (threads && *threads < 1) throw usage_error("--threads must be at least 1.");
  require_positive(exaggeration, "--exaggeration");
  if (eye.has_value() != target.has_value()) throw usage_error("--eye and --target belong together: give both.");
  if (view.has_value() + eye.has_value() + photo.has_value() > 1)
    throw usage_error("--view, --eye with --target, and --photo each choose the view: give one of them.");
  if (fov_deg && !(*fov_deg > 0 && *fov_deg < 180))
    throw usage_error("--fov takes an angle between 0 and 180 degrees.");
  if (eye && parse_place(*eye, "--eye") == parse_place(*target, "--target"))
    throw usage_error("--eye and --target must not be the same place.");

  const bool parallel = view && render::is_parallel(named_view(*view));
  refuse(orthographic && parallel, "--orthographic", "--view " + view.value_or("") + ", which is so already");
  refuse(fov_deg && parallel, "--fov", "--view " + view.value_or(""));
  refuse(fov_deg && orthographic && !eye, "--fov", "--orthographic, which fits the picture to the map");
  refuse(fov_deg && photo, "--fov", "--photo, which has its own camera");
  refuse(orthographic && photo, "--orthographic", "--photo, which has its own camera");
  if (photo && exaggeration != 1) throw usage_error("--exaggeration would not fit the photograph of --photo.");
  refuse(relief_range && chosen != Look::relief, "--relief-range", "--look " + look);
  refuse(no_legend && (!has_scale(chosen) || to == PictureKind::exr), "--no-legend",
         to == PictureKind::exr ? "OpenEXR files, which have none" : "--look " + look);
  refuse(quality && to != PictureKind::jpeg && to != PictureKind::webp, "--quality", "files other than .jpg and .webp");
}

render::PictureSize RenderOptions::picture_size(const std::vector<index::ImageRecord>& images) const {
  if (size) return parse_size(*size);
  if (!photo) return {};
  const camera::CameraModel& model = photograph(*photo, images).model;
  return {model.width_px, model.height_px};
}

render::View RenderOptions::chosen_view(const Box3d& bounds, const std::vector<index::ImageRecord>& images) const {
  const render::PictureSize px = picture_size(images);
  const double fov = fov_deg.value_or(kUsualFovDeg);
  if (photo) {
    const index::ImageRecord& image = photograph(*photo, images);
    return render::photograph_view({image.model, image.pose}, px);
  }
  if (eye) {
    const Vec3d from = parse_place(*eye, "--eye"), to = parse_place(*target, "--target");
    return orthographic ? render::parallel_view(from, to, fov, px)
                        : render::perspective_view(render::look_at(from, to), fov, px);
  }
  return render::named_view(view ? named_view(*view) : NamedView::overview, bounds, fov, orthographic, px);
}

}  // namespace skysweep::app
