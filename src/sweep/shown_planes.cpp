// SPDX-License-Identifier: Apache-2.0
#include "sweep/shown_planes.h"

#include <cstdlib>

namespace skysweep::sweep {
namespace {

// Both pixels lie off the photograph on the same side: so does the straight line between them.
bool off_the_same_side(const camera::CameraModel& model, Vec2d a, Vec2d b) {
  return (a.x < 0 && b.x < 0) || (a.y < 0 && b.y < 0) || (a.x > model.width_px && b.x > model.width_px) ||
         (a.y > model.height_px && b.y > model.height_px);
}

}  // namespace

void ShownPlanes::look_at(Vec2d place, PlaneRange planes) {
  everywhere_ = 0;
  partly_.clear();
  for (const View& view : problem_.views) add(view, place, planes);
}

void ShownPlanes::add(const View& view, Vec2d place, PlaneRange planes) {
  const camera::Camera& camera = view.camera;
  const auto pixel_at = [&](int k) { return camera.project({place.x, place.y, k * problem_.dz_m}); };
  const auto shown_at = [&](int k) {
    const std::optional<Vec2d> pixel = pixel_at(k);
    return pixel && camera.shows(*pixel);
  };
  const std::optional<Vec2d> low = pixel_at(planes.first), high = pixel_at(planes.last);
  if (low && high) {
    const bool shows_low = camera.shows(*low), shows_high = camera.shows(*high);
    if (shows_low && shows_high) {
      ++everywhere_;
      return;
    }
    if (shows_low != shows_high) {
      int shown = shows_low ? planes.first : planes.last, hidden = shows_low ? planes.last : planes.first;
      while (std::abs(shown - hidden) > 1) {
        const int middle = shown + (hidden - shown) / 2;
        (shown_at(middle) ? shown : hidden) = middle;
      }
      partly_.push_back(shows_low ? PlaneRange{planes.first, shown} : PlaneRange{shown, planes.last});
      return;
    }
    if (off_the_same_side(camera.model(), *low, *high)) return;
  }
  for (int k = planes.first; k <= planes.last; ++k) {
    if (!shown_at(k)) continue;
    const int first = k;
    while (k < planes.last && shown_at(k + 1)) ++k;
    partly_.push_back({first, k});
  }
}

int ShownPlanes::views_at(int k) const {
  const auto shows = [k](PlaneRange shown) { return shown.contains(k); };
  return everywhere_ + static_cast<int>(std::count_if(partly_.begin(), partly_.end(), shows));
}

}  // namespace skysweep::sweep
