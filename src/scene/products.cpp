// SPDX-License-Identifier: Apache-2.0
#include "scene/products.h"

#include <cstdio>

#include "core/error.h"
#include "formats/gcp_list.h"
#include "formats/pose_writers.h"
#include "scene/render/surveyed_points.h"

namespace skysweep::scene {
namespace {

constexpr std::uint64_t kTieStream = 0x71e, kControlStream = 0x9c9;

std::vector<formats::SparsePoint> sparse_points(const Scene& scene, const World& world,
                                                const std::vector<camera::Camera>& cameras) {
  SurveyOptions options;
  options.count = scene.truth.tie_points;
  options.stream = kTieStream;
  std::vector<formats::SparsePoint> out;
  for (const SurveyedPoint& point : survey(scene, world, cameras, options)) {
    formats::SparsePoint sparse{point.position + scene.origin, point.color, {}};
    for (const SurveyedPoint::Sighting& seen : point.sightings) sparse.track.push_back({seen.photograph, seen.pixel});
    out.push_back(std::move(sparse));
  }
  return out;
}

formats::GcpList control_points(const Scene& scene, const World& world,
                                const std::vector<formats::PosedImage>& photographs,
                                const std::vector<camera::Camera>& cameras) {
  SurveyOptions options;
  options.count = scene.ground_control->points;
  options.on_ground = true;
  options.stream = kControlStream;
  formats::GcpList list;
  list.crs = scene.crs;
  for (const SurveyedPoint& point : survey(scene, world, cameras, options)) {
    char name[16];
    std::snprintf(name, sizeof name, "gcp%03d", static_cast<int>(list.points.size()) + 1);
    formats::GroundControlPoint& control =
        list.points.emplace_back(formats::GroundControlPoint{name, point.position + scene.origin, {}});
    for (const SurveyedPoint::Sighting& seen : point.sightings)
      control.sightings.push_back({photographs[seen.photograph].name, seen.pixel});
  }
  if (list.points.empty())
    throw usage_error("none of the " + std::to_string(options.count) +
                      " ground control points lies on open ground that three photographs see: set more "
                      "ground_control.points, or fly with more overlap");
  return list;
}

}  // namespace

void require_products_possible(const Scene& scene) {
  const bool named = scene.crs.starts_with("EPSG:") || scene.crs.starts_with("+proj");
  if (scene.ground_control && !named)
    throw usage_error("[ground_control] needs a reference system that gcp_list.txt can name: set crs = \"EPSG:n\"");
}

void write_products(const Scene& scene, const World& world, const std::vector<formats::PosedImage>& photographs,
                    const std::vector<camera::Camera>& cameras, const std::filesystem::path& folder) {
  formats::write_colmap_text(folder / "sparse", photographs, sparse_points(scene, world, cameras));
  if (scene.ground_control)
    formats::write_gcp_list(folder / "gcp_list.txt", control_points(scene, world, photographs, cameras));
}

}  // namespace skysweep::scene
