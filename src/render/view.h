// SPDX-License-Identifier: Apache-2.0
// Where a picture is taken from: a ray for every pixel. Perspective views are cameras as photographs have them, lens
// distortion included; parallel (orthographic) ones have a fixed scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/box.h"
#include "render/ray.h"

namespace skysweep::render {

struct PictureSize {
  int width_px = 1280;
  int height_px = 720;
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

class View {
 public:
  explicit View(const camera::Camera& camera);
  // `pose.center` is where the middle of the picture lies; `pixel_m` the side of a pixel on the surface.
  View(const camera::Pose& pose, double pixel_m, PictureSize size);

  PictureSize size() const { return size_; }
  // Centre of the top-left pixel: (0.5, 0.5). Nothing where the lens model cannot be inverted.
  std::optional<Ray> ray(Vec2d pixel) const;
  PixelSize pixel() const { return pixel_; }
  // The direction of the middle of the picture, away from the camera.
  Vec3d direction() const { return pose_.view_direction(); }
  Vec3d right() const { return pose_.right(); }

 private:
  camera::Pose pose_;
  PictureSize size_;
  PixelSize pixel_;
  std::optional<camera::Camera> camera_;  // none: parallel
};

// A pose that looks from `eye` to `target` with the horizon level; looking plumb down or up, north is at the top.
// They must not be the same place.
camera::Pose look_at(Vec3d eye, Vec3d target);

// `fov_deg`: angle across the width of the picture, above 0 and below 180. A parallel view shows the target in the same
// size.
View perspective_view(const camera::Pose& pose, double fov_deg, PictureSize size);
View parallel_view(Vec3d eye, Vec3d target, double fov_deg, PictureSize size);

// Views that hold the whole surface, whatever its size and the picture's.
enum class NamedView {
  overview,  // from the south-south-west, 40 degrees above the horizon
  north,     // towards the north, 20 degrees above the horizon
  top,       // plumb from above, parallel, north at the top
  oblique,   // from the south-east, 45 degrees above the horizon, parallel
};
const std::vector<std::string>& named_view_names();  // in the order of the enumeration
bool is_parallel(NamedView view);

// All of `bounds` fills the picture but for a margin. With `parallel`, the same direction in parallel projection.
View named_view(NamedView view, const Box3d& bounds, double fov_deg, bool parallel, PictureSize size);

// The view of a photograph: its own camera in a picture of another size but the same shape. Throws Error(usage) if the
// shapes differ by more than a pixel's rounding.
View photograph_view(const camera::Camera& camera, PictureSize size);

}  // namespace skysweep::render
