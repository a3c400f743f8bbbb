// SPDX-License-Identifier: Apache-2.0
// A project that is run again: what has changed is made again, what has not is not touched, and the program can say
// which is which.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>

#include "app/simulated_flight.h"
#include "raster/geotiff.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::put_bytes;

class GrowingProject : public SimulatedFlight {
 protected:
  void run_well(const Arguments& more = {}, const std::string& name = "project") const {
    const Outcome outcome = run(more, name);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  int computed(const std::string& name = "project") const {
    return report_of(project(name)).at("tiles").at("computed").get<int>();
  }

  std::string some_tile() const {
    for (const auto& entry : fs::recursive_directory_iterator(project() / "tiles" / "dem" / "l0"))
      if (entry.is_regular_file())
        return "l0" + entry.path().parent_path().filename().string() + entry.path().stem().string();
    return {};
  }
  fs::path file_of(const std::string& tile, const std::string& layer) const {
    const std::size_t x = tile.find('x'), y = tile.find('y');
    return project() / "tiles" / layer / "l0" / tile.substr(x, y - x) / (tile.substr(y) + ".tif");
  }

  // Times of last change of everything but the reports of the run itself.
  std::map<std::string, fs::file_time_type> times() const {
    std::map<std::string, fs::file_time_type> found;
    for (const auto& entry : fs::recursive_directory_iterator(project())) {
      const std::string name = entry.path().filename();
      if (entry.is_regular_file() && name != "report.json" && name != "run.log" && name != ".lock")
        found[entry.path().lexically_relative(project()).string()] = entry.last_write_time();
    }
    return found;
  }
};

TEST_F(GrowingProject, run_with_nothing_changed_touches_nothing) {
  run_well();
  const auto before = times();
  const std::string catalogue = file_bytes(project() / "catalog.gpkg");
  EXPECT_TRUE(before.contains("dsm.tif") && before.contains("dsm.vrt") && before.contains("tiles/dem/top.tif"));
  run_well();
  EXPECT_TRUE(times() == before);
  EXPECT_TRUE(file_bytes(project() / "catalog.gpkg") == catalogue);
  run_well({"--verify"});
  EXPECT_EQ(computed(), 0);
}

TEST_F(GrowingProject, a_copy_of_the_project_is_as_good_as_the_project) {
  run_well();
  fs::copy(project(), project("copy"), fs::copy_options::recursive);
  run_well({}, "copy");
  EXPECT_EQ(computed("copy"), 0);
  EXPECT_TRUE(rasters_in(project("copy")) == rasters_in(project()));
}

TEST_F(GrowingProject, mosaics_that_are_missing_or_were_changed_are_written_again) {
  run_well();
  const auto before = rasters_in(project());
  fs::remove(project() / "dsm.tif");
  put_bytes(project() / "ortho.tif", "no raster");
  run_well();
  EXPECT_EQ(computed(), 0);
  EXPECT_TRUE(rasters_in(project()) == before);
}

TEST_F(GrowingProject, photograph_is_taken_out_and_back_by_name) {
  run_well({"--dz=0.05"});
  const auto whole = rasters_in(project());
  run_well({"--remove=*3.jpg"});
  EXPECT_EQ(image_in_report(project(), "0003.jpg").at("status"), "removed");
  EXPECT_GT(computed(), 0);
  EXPECT_FALSE(rasters_in(project()) == whole);
  run_well();
  EXPECT_EQ(computed(), 0) << "it stays out";
  const Outcome info = skysweep({"info", project()});
  EXPECT_TRUE(says(info.out, {"5 of 6 used", "removed    0003.jpg: taken out with --remove"}));
  run_well({"--restore=0003.jpg"});
  EXPECT_TRUE(rasters_in(project()) == whole);
  EXPECT_EQ(image_in_report(project(), "0003.jpg").at("status"), "used");
}

TEST_F(GrowingProject, patterns_that_match_nothing_or_too_much_are_usage_errors) {
  run_well();
  const auto before = rasters_in(project());
  const auto expect_refused = [&](const char* option, const std::vector<std::string>& words) {
    const Outcome outcome = run({option});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, words));
  };
  expect_refused("--remove=DJI*", {"--remove DJI*", "matches no photograph", "relative to the image folder"});
  expect_refused("--restore=0003.jpg", {"--restore 0003.jpg", "matches no photograph that was removed"});
  expect_refused("--remove=000[1-5].jpg", {"1 photographs are left", "--restore"});
  EXPECT_TRUE(rasters_in(project()) == before);
  EXPECT_FALSE(fs::exists(project() / "removed.toml"));
}

TEST_F(GrowingProject, info_says_why_a_tile_is_stale) {
  run_well();
  const std::string tile = some_tile();
  const auto info = [&] { return skysweep({"info", project(), "--tile", tile}).out; };
  EXPECT_TRUE(says(info(), {tile, "It is up to date: the photographs that may show it are those it was made from."}));

  const std::string photograph = file_bytes(photo("0001.jpg"));
  std::map<std::string, std::string> photographs;
  for (const auto& entry : fs::directory_iterator(images())) photographs[entry.path()] = file_bytes(entry.path());
  for (const auto& [path, bytes] : photographs) put_bytes(path, photograph);
  EXPECT_TRUE(says(info(), {"It is stale, the next run computes it: 000", ".jpg has other bytes"}));
  for (const auto& [path, bytes] : photographs) put_bytes(path, bytes);
  EXPECT_TRUE(says(info(), {"It is up to date"}));

  fs::resize_file(file_of(tile, "color"), 100);
  EXPECT_TRUE(says(info(), {"It is stale", "its files are missing or not as they were written"}));
  fs::rename(images(), folder / "elsewhere");
  EXPECT_TRUE(says(info(), {"The photographs' folder", "is not there: judged by what the last run saw"}));
}

TEST_F(GrowingProject, log_says_why_tiles_were_computed_again) {
  run_well();
  replace_in_poses("0003.jpg,", "0003.jpg,0");  // the same number in other letters changes nothing
  run_well();
  EXPECT_EQ(computed(), 0);
  fs::rename(photo("0004.jpg"), folder / "0004.jpg");
  const Outcome outcome = run();
  EXPECT_TRUE(says(outcome.err, {"1 photographs of earlier runs are not in", "0004.jpg", "made without them"}));
  EXPECT_TRUE(says(file_bytes(project() / "run.log"), {"is stale: 0004.jpg does not show it any more or is gone"}));
}

TEST_F(GrowingProject, dry_run_counts_what_a_run_would_compute) {
  EXPECT_TRUE(says(run({"--dry-run"}).out, {"to compute, 0 up to date"}));
  run_well();
  EXPECT_TRUE(says(run({"--dry-run"}).out, {"(0 to compute, "}));
  fs::remove(file_of(some_tile(), "mask"));
  EXPECT_TRUE(says(run({"--dry-run"}).out, {"(1 to compute, "}));
}

TEST_F(GrowingProject, damaged_tile_is_found_and_made_again_with_a_word) {
  run_well();
  const auto before = rasters_in(project());
  const std::string tile = some_tile();
  std::string bytes = file_bytes(file_of(tile, "dem"));
  bytes[bytes.size() / 2] ^= 0x10;
  put_bytes(file_of(tile, "dem"), bytes);
  put_bytes(project() / "tiles" / "color" / "top.tif", "no raster");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome.err, {"The tile " + tile + " is stale: its files are missing or not as they were written",
                                 "The tile top is missing or not as it was written: it is made again"}));
  EXPECT_EQ(computed(), 1);
  EXPECT_TRUE(rasters_in(project()) == before);
}

TEST_F(GrowingProject, damaged_catalogue_is_kept_aside_and_made_again_from_the_tiles) {
  run_well();
  const auto before = rasters_in(project());
  const std::string whole = file_bytes(project() / "catalog.gpkg");
  const int empty = report_of(project()).at("tiles").at("empty");
  for (const std::string& damaged : {std::string("no database"), whole.substr(0, whole.size() / 2),
                                     whole.substr(0, 8192) + std::string(whole.size() - 8192, '\x5a')}) {
    put_bytes(project() / "catalog.gpkg", damaged);
    EXPECT_EQ(run({"--dry-run"}).exit_code, 0) << "looking needs no catalogue";
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.err, {"The catalogue was damaged", "catalog.damaged.gpkg"}));
    EXPECT_TRUE(file_bytes(project() / "catalog.damaged.gpkg") == damaged);
    EXPECT_EQ(computed(), empty) << "only tiles without files are looked at again";
    EXPECT_TRUE(rasters_in(project()) == before);
  }
  fs::remove(project() / "catalog.gpkg");
  run_well();
  EXPECT_EQ(computed(), empty);
  EXPECT_TRUE(rasters_in(project()) == before);
  EXPECT_TRUE(says(skysweep({"info", project()}).out, {"6 of 6 used"}));
}

TEST_F(GrowingProject, is_written_by_one_process_at_a_time) {
  fs::create_directories(project());
  put_bytes(project() / ".lock", "process 1 on elsewhere\n");  // of a process that was killed: no hindrance
  run_well();
  const auto before = rasters_in(project());
  const int other = ::open((project() / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
  const Outcome outcome = run({"--fresh"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(says(outcome.err, {project().string(), "is being written by process ", "wait until it has finished"}));
  EXPECT_TRUE(rasters_in(project()) == before);
  EXPECT_EQ(skysweep({"info", project()}).exit_code, 0) << "looking is free";
  ::close(other);
  run_well();
}

TEST_F(GrowingProject, virtual_mosaics_show_the_cells_of_the_tiles) {
  run_well();
  const raster::Raster<float> map = raster::read_float_raster(project() / "dsm.vrt");
  for (const auto& entry : fs::recursive_directory_iterator(project() / "tiles" / "dem" / "l0")) {
    if (!entry.is_regular_file()) continue;
    const raster::Raster<float> tile = raster::read_float_raster(entry.path());
    const Vec2d at = tile.georeference.north_west_corner, corner = map.georeference.north_west_corner;
    const int column = static_cast<int>(std::lround((at.x - corner.x) / 0.1));
    const int row = static_cast<int>(std::lround((corner.y - at.y) / 0.1));
    EXPECT_TRUE(same_bits(crop(map.values, column, row, tile.values.width(), tile.values.height()), tile.values))
        << entry.path();
  }
  EXPECT_EQ(map.labels.content, "surface height");
  EXPECT_EQ(map.labels.units, "metre");
  EXPECT_EQ(map.labels.vertical_reference, raster::read_labels(project() / "dsm.tif").vertical_reference);
  EXPECT_EQ(raster::read_color_raster(project() / "ortho.vrt").values.width(), map.values.width());
  // The overview is the next level, cell on cell.
  const raster::Raster<float> half = raster::read_float_raster(project() / "tiles" / "dem" / "l1.vrt");
  EXPECT_EQ(half.values.width(), map.values.width() / 2);
  EXPECT_EQ(half.georeference.north_west_corner, map.georeference.north_west_corner);
  fs::rename(project(), folder / "moved");
  EXPECT_TRUE(same_bits(raster::read_float_raster(folder / "moved" / "dsm.vrt").values, map.values));
}

}  // namespace
}  // namespace skysweep::app_test
