// SPDX-License-Identifier: Apache-2.0
// What `skysweep render` was asked for, as typed and as understood.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "index/image_record.h"
#include "render/height_hierarchy.h"
#include "render/picture.h"

namespace skysweep::app {

enum class PictureKind { png, jpeg, webp, exr };
enum class RenderBackend { automatic, cpu, gpu };

struct RenderOptions {
  std::string project, output;
  std::string look = "orthophoto";
  std::string surface = "bilinear";
  std::optional<std::string> view, eye, target, photo, size, area, sun, background, relief_range;
  std::optional<double> fov_deg;
  std::optional<int> quality, threads, samples;
  double exaggeration = 1;
  std::string memory = "2GiB";
  std::string backend = "auto";
  bool orthographic = false, shadows = false, no_legend = false, exact = false, json_log = false;

  // Throws Error(usage) for anything that can be seen to be wrong without the map.
  void check() const;

  // All of these throw Error(usage), naming the option.
  PictureKind kind() const;  // from the ending of the output
  render::LookOptions look_options() const;
  render::PictureOptions picture_options() const;
  render::SurfaceForm surface_form() const;
  int quality_or_default() const;
  RenderBackend chosen_backend() const;

  // `images`: of the catalogue. `bounds`: of the drawn surface.
  render::View chosen_view(const Box3d& bounds, const std::vector<index::ImageRecord>& images) const;
  // How large the picture will be.
  render::PictureSize picture_size(const std::vector<index::ImageRecord>& images) const;
};

}  // namespace skysweep::app
