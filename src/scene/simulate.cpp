// SPDX-License-Identifier: Apache-2.0
#include "scene/simulate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "camera/camera.h"
#include "core/error.h"
#include "core/random.h"
#include "formats/pose_set.h"
#include "formats/pose_writers.h"
#include "raster/atomic_file.h"
#include "raster/crs.h"
#include "raster/digest.h"
#include "raster/photo.h"
#include "scene/effects/scene_effects.h"
#include "scene/flight/clearance.h"
#include "scene/flight_plan.h"
#include "scene/metadata.h"
#include "scene/products.h"
#include "scene/render/class_map.h"
#include "scene/render/memory_plan.h"
#include "scene/render/taken_photograph.h"
#include "scene/render/truth.h"
#include "scene/scene_file.h"
#include "scene/world/world.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kExposureStream = 0xe0;

void require_usable(const Scene& scene) {
  if (const auto problem = scene.camera.problem())
    throw usage_error("the camera of the scene cannot be used: " + *problem);
  constexpr double kMostCells = 4e8;
  const double cell = scene.truth_cell_m();
  if (scene.area_m.x / cell * (scene.area_m.y / cell) > kMostCells)
    throw usage_error("the truth of the scene would have more than 400 million cells: set a larger truth.cell_m");
}

void require_flyable(const Scene& scene, const std::vector<camera::Pose>& poses, const Box2d& visible) {
  if (poses.size() > 9999)
    throw usage_error("the flight of the scene takes " + std::to_string(poses.size()) +
                      " photographs, more than the 9999 that can be numbered: ask for less overlap or area");
  constexpr double kMostVisible_m = 1e5;
  if (std::max(visible.width(), visible.height()) > kMostVisible_m)
    throw usage_error("the photographs of the scene see more than 100 km of ground: fly lower or look down more");
  const std::vector<const Flight*> flights = scene.flights();
  if (!std::all_of(flights.begin(), flights.end(), [](const Flight* f) { return flies_over_everything(*f); }))
    return;  // decided place by place: require_above_surface
  const Ground ground(scene);
  const double objects = tallest_object_m(scene);
  for (const camera::Pose& pose : poses) {
    // Plain ground is bounded everywhere; on any other a flight may climb with it.
    const Vec2d below{pose.center.x, pose.center.y};
    double highest = ground.plain() ? 0.5 * scene.terrain.relief_m : ground.surface_m(below);
    highest += objects;
    for (const Building& building : scene.buildings) highest = std::max(highest, building.roof_z_m);
    if (pose.center.z <= highest)
      throw usage_error("the flight is at " + std::to_string(std::lround(pose.center.z)) +
                        " m, but the scene reaches up to " + std::to_string(std::lround(highest)) +
                        " m: raise flight.gsd_m or camera.focal_px");
  }
}

std::vector<formats::PosedImage> name_photographs(const Scene& scene, const std::vector<camera::Pose>& poses) {
  const std::string ending = file_ending(scene.photographs.format);
  std::vector<formats::PosedImage> out;
  for (const camera::Pose& pose : poses) {
    char name[32];
    std::snprintf(name, sizeof name, "%04d.%s", static_cast<int>(out.size()) + 1, ending.c_str());
    out.push_back(
        {name, scene.camera, {pose.cam_from_world, camera::snap_position(pose.center + scene.origin)}, "simulated"});
  }
  return out;
}

// Photographs of another scene beside these would be taken for part of this one.
void require_no_others(const fs::path& images, const std::vector<formats::PosedImage>& ours) {
  if (!fs::exists(images)) return;
  std::set<std::string> names;
  for (const formats::PosedImage& image : ours) names.insert(image.name);
  for (const std::string& name : raster::list_photos(images))
    if (!names.contains(name))
      throw usage_error((images / name).string() + " is not of this scene: simulate into an empty folder");
}

Exposure exposure_of(const Scene& scene, std::size_t index) {
  Random random(mix64(scene.seed) ^ mix64(kExposureStream + (index << 8)));
  Exposure out;
  out.noise_seed = random.next();
  const double deviation = random.normal();
  if (scene.photographs.gain_spread > 0) out.gain = std::exp(scene.photographs.gain_spread * deviation);
  out.noise_sigma = scene.photographs.noise_sigma;
  return out;
}

void write_truth(const Scene& scene, const std::string& crs, const TruthGrid& grid, const TruthLayers& truth,
                 const std::string& software, const fs::path& folder) {
  const raster::GeoReference where{crs, grid.north_west_corner, grid.cell_m};
  const std::string digest = raster::digest_of_bytes(scene_to_json(scene));
  write_geotiff(folder / "dsm.tif",
                raster::Raster<float>{
                    truth.dsm, where, {"surface height", "metre", raster::vertical_reference(crs), software, digest}});
  write_geotiff(folder / "dtm.tif",
                raster::Raster<float>{
                    truth.dtm, where, {"ground height", "metre", raster::vertical_reference(crs), software, digest}});
  write_geotiff(folder / "ortho.tif", raster::Raster<Rgba8>{truth.ortho, where, {"colour", "", "", software, digest}});
  write_geotiff(folder / "views.tif",
                raster::Raster<std::uint8_t>{truth.views, where, {"number of photographs", "", "", software, digest}});
  write_geotiff(folder / "classes.tif",
                raster::Raster<std::uint8_t>{truth.classes, where, {kClassesContent, "", "", software, digest}});
}

}  // namespace

Simulation simulate(const Scene& scene, const fs::path& folder, Executor& executor, const SimulationOptions& options) {
  require_usable(scene);
  require_products_possible(scene);
  require_metadata_possible(scene);
  const std::string crs = scene.crs.empty() ? raster::local_metric_crs() : raster::crs_from_user_input(scene.crs);
  const std::vector<camera::Pose> poses = plan_flight(scene);
  const Box2d visible = visible_ground(scene, poses);
  require_flyable(scene, poses, visible);
  const std::unique_ptr<SceneEffects> effects = make_effects(scene, poses);
  World world(scene, visible);
  require_above_surface(world, poses);
  if (effects) effects->change_world(world);
  const std::vector<formats::PosedImage> photographs = name_photographs(scene, poses);
  raster::require_writable_folder(folder);
  require_no_others(folder / "images", photographs);
  const auto recorded = effects ? effects->recorded(photographs) : photographs;
  formats::write_poses_csv(folder / "poses.csv", recorded);
  raster::write_bytes_atomically(folder / "scene.json", scene_to_json(scene));

  const PixelRays rays(scene.camera);
  const TruthGrid grid = truth_grid(scene);
  if (options.begin) options.begin(static_cast<int>(poses.size()), planned_bytes(scene, grid));
  const int total = static_cast<int>(poses.size()) + 1;
  const auto report = [&](int done) {
    if (options.progress) options.progress(done, total);
  };
  std::vector<camera::Camera> cameras;
  for (const camera::Pose& pose : poses) cameras.emplace_back(scene.camera, pose);
  write_products(scene, world, recorded, cameras, folder);
  const std::vector<formats::PhotoMetadata> metadata = metadata_of(scene, recorded, crs, options.software);
  const auto write = [&](std::size_t i, const TakenPhotograph& photograph) {
    write_taken(scene, photograph, photographs[i].name, metadata.empty() ? nullptr : &metadata[i], options.software,
                folder);
  };

  // Encoding and writing take one thread: the others render the next photograph meanwhile.
  TakenPhotograph taken;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    TakenPhotograph next;
    const auto changes = effects ? effects->photograph(i, world) : nullptr;
    executor.parallel_for(2, [&](int part) {
      if (part == 1)
        next = take(scene, world, rays, poses[i], exposure_of(scene, i), changes.get(), executor);
      else if (i > 0)
        write(i - 1, taken);
    });
    taken = std::move(next);
    report(static_cast<int>(i) + 1);
  }
  write(poses.size() - 1, taken);
  write_truth(scene, crs, grid, make_truth(world, grid, scene.origin, cameras, scene.facade_edge_reach_m(), executor),
              options.software, folder / "truth");
  if (effects && effects->spoils_metadata()) formats::write_poses_csv(folder / "truth/poses.csv", photographs);
  report(total);
  return {static_cast<int>(poses.size()), scene.gsd_m(), grid.cell_m, effects ? effects->rays_per_pixel() : 4,
          effects ? effects->report() : nothing_runs()};
}

}  // namespace skysweep::scene
