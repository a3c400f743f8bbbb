// SPDX-License-Identifier: Apache-2.0
#include "scene/simulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "core/error.h"
#include "formats/pose_set.h"
#include "raster/geotiff.h"
#include "raster/photo.h"

namespace skysweep::scene {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder =
      fs::path(testing::TempDir()) /
      (std::string("scene_") + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name);
  fs::remove_all(folder);
  return folder;
}

std::string bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

// Few small photographs of a town without compression.
Scene tiny_town() {
  Scene scene;
  scene.area_m = {20, 16};
  scene.terrain = {0.8, 25};
  scene.town.emplace();
  scene.town->block_m = 12;
  scene.town->street_m = 6;
  scene.town->heading_deg = 12;
  scene.town->min_height_m = 2;
  scene.town->max_height_m = 5;
  scene.camera = camera::camera_from_sensor(10, 10, 200, 150);
  scene.flight.gsd_m = 0.1;
  scene.flight.along_overlap = 0.6;
  scene.flight.across_overlap = 0.5;
  scene.flight.beyond_area_m = -4;
  scene.photographs.format = PhotoFormat::png;
  return scene;
}

// Level ground, one building, cameras straight above: everything can be told by hand.
Scene one_building() {
  Scene scene = tiny_town();
  scene.town.reset();
  scene.terrain = {};
  scene.buildings = {{{10, 8}, {6, 4}, 0, 5.5}};
  scene.truth.cell_m = 0.25;
  return scene;
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) out.push_back(fs::relative(entry.path(), folder).string());
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Simulate, the_same_seed_gives_the_same_bytes_for_one_and_two_threads) {
  Scene scene = tiny_town();
  scene.photographs.noise_sigma = 3;
  scene.photographs.gain_spread = 0.1;
  const fs::path a = fresh_folder("a"), b = fresh_folder("b");
  SerialExecutor serial;
  ThreadExecutor two(2);
  simulate(scene, a, serial);
  simulate(scene, b, two);
  const std::vector<std::string> files = files_below(a);
  EXPECT_EQ(files, files_below(b));
  EXPECT_GE(files.size(), 10u);
  for (const std::string& file : files) EXPECT_EQ(bytes(a / file), bytes(b / file)) << file;
}

TEST(Simulate, another_seed_gives_another_town) {
  Scene scene = tiny_town();
  const fs::path a = fresh_folder("a"), b = fresh_folder("b");
  SerialExecutor executor;
  simulate(scene, a, executor);
  scene.seed = 2;
  simulate(scene, b, executor);
  EXPECT_NE(bytes(a / "images/0001.png"), bytes(b / "images/0001.png"));
}

TEST(Simulate, another_origin_moves_poses_and_truth_but_changes_no_photograph) {
  Scene scene = tiny_town();
  const fs::path a = fresh_folder("a"), b = fresh_folder("b");
  SerialExecutor executor;
  const Simulation simulation = simulate(scene, a, executor);
  scene.origin = {691000, 5334000, 128};
  simulate(scene, b, executor);
  for (const std::string& name : raster::list_photos(a / "images"))
    EXPECT_EQ(bytes(a / "images" / name), bytes(b / "images" / name)) << name;
  const auto here = raster::read_float_raster(a / "truth/dsm.tif"),
             there = raster::read_float_raster(b / "truth/dsm.tif");
  EXPECT_NEAR(there.georeference.north_west_corner.x - here.georeference.north_west_corner.x, 691000, 1e-6);
  ASSERT_EQ(here.values.size(), there.values.size());
  for (std::size_t i = 0; i < here.values.size(); ++i)
    EXPECT_NEAR(there.values.data()[i] - 128, here.values.data()[i], 2e-5);
  const auto poses = formats::read_poses((a / "poses.csv").string()),
             moved = formats::read_poses((b / "poses.csv").string());
  ASSERT_EQ(poses.images.size(), static_cast<std::size_t>(simulation.photographs));
  EXPECT_EQ(moved.images[0].pose.center - poses.images[0].pose.center, (Vec3d{691000, 5334000, 128}));
}

TEST(Simulate, effects_change_photographs_but_neither_poses_nor_truth) {
  Scene scene = tiny_town();
  const fs::path plain = fresh_folder("plain"), noisy = fresh_folder("noisy"), bright = fresh_folder("bright");
  SerialExecutor executor;
  simulate(scene, plain, executor);
  scene.photographs.noise_sigma = 4;
  simulate(scene, noisy, executor);
  scene.photographs.noise_sigma = 0;
  scene.photographs.gain_spread = 0.2;
  simulate(scene, bright, executor);
  EXPECT_EQ(bytes(plain / "poses.csv"), bytes(noisy / "poses.csv"));
  EXPECT_EQ(bytes(plain / "poses.csv"), bytes(bright / "poses.csv"));
  EXPECT_EQ(raster::read_color_raster(plain / "truth/ortho.tif").values,
            raster::read_color_raster(noisy / "truth/ortho.tif").values);
  const Array2d<Rgb8> a = raster::read_photo(plain / "images/0001.png"),
                      b = raster::read_photo(noisy / "images/0001.png");
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.data()[i].g < 30 || a.data()[i].g > 225) continue;  // clipping would shorten the tails
    squares += std::pow(double(b.data()[i].g) - a.data()[i].g, 2);
    ++count;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 4, 0.2);  // rounding adds a little
  EXPECT_NE(bytes(plain / "images/0001.png"), bytes(bright / "images/0001.png"));
}

TEST(Simulate, truth_heights_of_ground_and_roof_are_exact) {
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(one_building(), folder, executor);
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  EXPECT_EQ(dsm.values.width(), 80);
  EXPECT_EQ(dsm.values.height(), 64);
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 80; ++column) {
      const Vec2d p = dsm.georeference.cell_center(column, row);
      const bool roof = std::abs(p.x - 10) < 3 && std::abs(p.y - 8) < 2;
      EXPECT_EQ(dsm.values(column, row), roof ? 5.5f : 0.f) << p.x << " " << p.y;
    }
}

// By hand: a camera sees a point of the roof if it shows it; a point of the ground if also the segment from the point
// to the camera does not enter the building.
TEST(Simulate, views_are_counted_as_by_hand) {
  const Scene scene = one_building();
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(scene, folder, executor);
  const auto views = raster::read_class_raster(folder / "truth/views.tif");
  std::vector<camera::Camera> cameras;
  for (const auto& image : formats::read_poses((folder / "poses.csv").string()).images)
    cameras.emplace_back(image.model, image.pose);
  const auto enters_building = [](Vec3d from, Vec3d to) {
    for (int i = 1; i < 4000; ++i) {
      const Vec3d p = from + (i / 4000.) * (to - from);
      if (std::abs(p.x - 10) < 3 && std::abs(p.y - 8) < 2 && p.z < 5.5) return true;
    }
    return false;
  };
  int different = 0, hidden = 0, asked = 0;
  for (int row = 0; row < views.values.height(); row += 3)
    for (int column = 0; column < views.values.width(); column += 3) {
      const Vec2d p = views.georeference.cell_center(column, row);
      const bool roof = std::abs(p.x - 10) < 3 && std::abs(p.y - 8) < 2;
      const Vec3d point{p.x, p.y, roof ? 5.5 : 0};
      int expected = 0;
      for (const camera::Camera& camera : cameras) {
        const auto pixel = camera.project(point);
        if (!pixel || !camera.shows(*pixel)) continue;
        if (!roof && enters_building(point, camera.pose().center))
          ++hidden;
        else
          ++expected;
      }
      ++asked;
      different += views.values(column, row) != expected;
    }
  EXPECT_GT(hidden, 50);
  EXPECT_LE(different, asked / 200);  // grazing rays, decided a centimetre above the ground
}

double bilinear(const Array2d<Rgb8>& photo, Vec2d pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0., photo.width() - 1.001),
               y = std::clamp(pixel.y - 0.5, 0., photo.height() - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * photo(i, j).g + s * photo(i + 1, j).g) +
         t * ((1 - s) * photo(i, j + 1).g + s * photo(i + 1, j + 1).g);
}

TEST(Simulate, truth_cells_projected_into_photographs_have_the_colours_of_the_true_orthophoto) {
  Scene scene = tiny_town();
  scene.camera.distortion = {-0.12, 0.03, 0.0005, -0.0004, 0};
  scene.flight.tilt_sigma_deg = 2;
  scene.flight.position_sigma_m = 0.3;
  scene.origin = {1000.5, -2000.25, 300};
  scene.texture.contrast = 0.6;
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(scene, folder, executor);
  const auto dsm = raster::read_float_raster(folder / "truth/dsm.tif");
  const auto ortho = raster::read_color_raster(folder / "truth/ortho.tif");
  const auto views = raster::read_class_raster(folder / "truth/views.tif");
  const auto poses = formats::read_poses((folder / "poses.csv").string());
  const int photographs = static_cast<int>(poses.images.size());
  std::vector<Array2d<Rgb8>> photos;
  for (const auto& image : poses.images) photos.push_back(raster::read_photo(folder / "images" / image.name));

  double squares = 0, squares_off = 0;
  int count = 0;
  const double cell = dsm.georeference.cell_m;
  for (int row = 1; row + 1 < dsm.values.height(); ++row)
    for (int column = 1; column + 1 < dsm.values.width(); ++column) {
      const double z = dsm.values(column, row);
      // Away from walls, where neighbouring cells belong to one surface.
      bool smooth = true;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) smooth = smooth && std::abs(dsm.values(column + i, row + j) - z) < 0.1;
      if (!smooth) continue;
      const Vec2d center = dsm.georeference.cell_center(column, row);
      int showing = 0;
      std::vector<double> colors, colors_off;  // the latter half a pixel beside
      for (int v = 0; v < photographs; ++v) {
        const camera::Camera camera(poses.images[static_cast<std::size_t>(v)].model,
                                    poses.images[static_cast<std::size_t>(v)].pose);
        const auto pixel = camera.project({center.x, center.y, z});
        if (!pixel || !camera.shows(*pixel)) continue;
        ++showing;
        double sum = 0, sum_off = 0;
        for (int k = 0; k < 16; ++k) {
          const Vec2d p = center + cell * Vec2d{(k % 4 + 0.5) / 4 - 0.5, (k / 4 + 0.5) / 4 - 0.5};
          const Vec2d position = *camera.project({p.x, p.y, z});
          sum += bilinear(photos[static_cast<std::size_t>(v)], position);
          sum_off += bilinear(photos[static_cast<std::size_t>(v)], position + Vec2d{0.5, 0.5});
        }
        colors.push_back(sum / 16);
        colors_off.push_back(sum_off / 16);
      }
      if (showing != views.values(column, row)) continue;  // hidden in some
      for (std::size_t v = 0; v < colors.size(); ++v) {
        squares += std::pow(colors[v] - ortho.values(column, row).g, 2);
        squares_off += std::pow(colors_off[v] - ortho.values(column, row).g, 2);
        ++count;
      }
    }
  const auto psnr = [&](double sum) { return 10 * std::log10(255 * 255 / (sum / count)); };
  EXPECT_GT(count, 5000);
  EXPECT_GT(psnr(squares), 36);
  EXPECT_LT(psnr(squares_off), psnr(squares) - 5);  // the figure does tell geometry right to a fraction of a pixel
}

TEST(Simulate, photographs_of_another_scene_in_the_folder_are_refused_not_mixed) {
  Scene scene = one_building();
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  simulate(scene, folder, executor);
  scene.flight.beyond_area_m = -7.9;  // fewer photographs
  EXPECT_THROW(simulate(scene, folder, executor), Error);
}

TEST(Simulate, a_flight_below_the_roofs_and_an_unknown_crs_are_refused_before_any_work) {
  Scene scene = one_building();
  scene.buildings[0].roof_z_m = 50;
  const fs::path folder = fresh_folder("a");
  SerialExecutor executor;
  EXPECT_THROW(simulate(scene, folder, executor), Error);
  scene = one_building();
  scene.crs = "EPSG:4326";
  EXPECT_THROW(simulate(scene, folder, executor), Error);
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Simulate, an_orbit_may_pass_below_a_roof_but_not_through_the_building) {
  Scene scene = one_building();
  scene.flight = {};
  scene.flight.pattern = FlightPattern::orbit;
  scene.flight.target = {10, 8, 0};
  scene.flight.altitudes_m = {4};  // the roof is at 5.5
  scene.flight.photographs = 4;
  scene.flight.radius_m = 12;
  SerialExecutor executor;
  EXPECT_EQ(simulate(scene, fresh_folder("beside"), executor).photographs, 4);
  scene.flight.radius_m = 2;  // east and west of the target that is inside
  const fs::path folder = fresh_folder("through");
  try {
    simulate(scene, folder, executor);
    ADD_FAILURE() << "flown through a building";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("below the surface at its place"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder));
}

TEST(Simulate, what_it_will_hold_is_said_before_the_first_photograph) {
  const auto said = [](const Scene& scene) {
    std::vector<std::string> order;
    std::uint64_t bytes = 0;
    SimulationOptions options;
    options.begin = [&](int photographs, std::uint64_t bytes_to_come) {
      EXPECT_GT(photographs, 1);
      bytes = bytes_to_come;
      order.push_back("begin");
    };
    options.progress = [&](int, int) { order.push_back("progress"); };
    SerialExecutor executor;
    simulate(scene, fresh_folder("a"), executor, options);
    EXPECT_EQ(order[0], "begin");
    EXPECT_EQ(std::count(order.begin(), order.end(), "begin"), 1);
    return bytes;
  };
  Scene scene = one_building();
  const std::uint64_t plain = said(scene);
  EXPECT_GE(plain, 200u * 150 * 2 * 3);
  EXPECT_LE(plain, 100u << 20);
  scene.truth.depth = true;
  EXPECT_GE(said(scene), plain + 200 * 150 * 2 * 4);
  scene.truth.depth = false;
  scene.truth.cell_m = 0.02;
  EXPECT_GE(said(scene), plain + 1000u * 800 * 8);
}

TEST(Simulate, progress_counts_photographs_and_the_truth) {
  std::vector<int> seen;
  int of = 0;
  SerialExecutor executor;
  const Simulation simulation =
      simulate(one_building(), fresh_folder("a"), executor, {"skysweep", {}, [&](int done, int total) {
                                                               seen.push_back(done);
                                                               of = total;
                                                             }});
  EXPECT_EQ(of, simulation.photographs + 1);
  EXPECT_EQ(static_cast<int>(seen.size()), of);
  EXPECT_EQ(seen.back(), of);
}

}  // namespace
}  // namespace skysweep::scene
