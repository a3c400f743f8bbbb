// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tile_digest.h"

#include "raster/digest.h"

namespace skysweep::pipeline {
namespace {

using index::ImageRecord;

constexpr std::size_t kShortDigits = 16;  // of a photograph among those of one tile: 64 bits are plenty

// A zero is a zero: databases do not keep its sign.
void add_number(raster::Digest& digest, double value) {
  value += 0.0;
  digest.add_bytes({reinterpret_cast<const char*>(&value), sizeof value});
}

std::string camera_and_pose_digest(const ImageRecord& image) {
  const camera::CameraModel& m = image.model;
  const Vec3d c = image.pose.center;
  raster::Digest digest;
  for (const double v : {m.fx_px, m.fy_px, m.cx_px, m.cy_px, m.distortion.k1, m.distortion.k2, m.distortion.p1,
                         m.distortion.p2, m.distortion.k3, c.x, c.y, c.z})
    add_number(digest, v);
  for (const double r : image.pose.cam_from_world.m) add_number(digest, r);
  return digest.hex();
}

void add_photograph(raster::Digest& digest, const ImageRecord& image) {
  digest.add_field(image.name);
  digest.add_field(image.content_digest);
  digest.add_field(camera_and_pose_digest(image));
}

void add_range(raster::Digest& digest, const std::optional<sweep::HeightRange>& range) {
  digest.add_field(range ? "range" : "none");
  if (!range) return;
  add_number(digest, range->z_low);
  add_number(digest, range->z_high);
}

}  // namespace

std::string settings_digest(const ProjectSettings& settings) {
  return raster::digest_of_bytes(settings_text(settings));
}

std::string view_digest(const ImageRecord& image) {
  return raster::digest_of_bytes(image.content_digest).substr(0, kShortDigits) + "-" +
         camera_and_pose_digest(image).substr(0, kShortDigits);
}

std::string photograph_digest(const ImageRecord& image) {
  raster::Digest digest;
  add_photograph(digest, image);
  return digest.hex();
}

TileInputs::TileInputs(const TileGeometry& geometry, const std::optional<sweep::HeightRange>& found)
    : guess(geometry.select(geometry.guessed_heights())),
      heights(found),
      chosen(found ? geometry.select(*found) : guess) {}

std::string TileInputs::digest(tiles::TileKey key, const TileGeometry& geometry,
                               const std::vector<const ImageRecord*>& candidates, const std::string& settings) const {
  raster::Digest digest;
  digest.add_field(key.name());
  digest.add_field(settings);
  const auto add_views = [&](const index::ViewSelection& selection, const sweep::HeightRange& at) {
    digest.add_field("views");
    const std::vector<int> levels = geometry.base_levels(selection, at);
    for (std::size_t i = 0; i < selection.chosen.size(); ++i) {
      add_photograph(digest, *candidates[selection.chosen[i]]);
      add_number(digest, levels[i]);
    }
  };
  const sweep::HeightRange guessed = geometry.guessed_heights();
  add_views(guess, guessed);
  add_range(digest, geometry.guess_is_compared_on() ? std::optional(guessed) : std::nullopt);
  add_range(digest, geometry.searched_heights());
  add_range(digest, heights);
  add_views(chosen, heights.value_or(guessed));
  return digest.hex();
}

}  // namespace skysweep::pipeline
