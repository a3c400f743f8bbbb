// SPDX-License-Identifier: Apache-2.0
// Hard cases of whole flights, from photographs and poses to tiles: what only the pipeline can refuse, or say in words.
#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>

#include "core/error.h"
#include "core/random.h"
#include "formats/pose_set.h"
#include "formats/pose_writers.h"
#include "laws/small_flight.h"
#include "raster/geotiff.h"
#include "raster/photo.h"

namespace skysweep::hard {
namespace {

constexpr const char* kTinyScene = R"(
seed = 7
area_m = [7, 6]

[terrain]
relief_m = 0.4
wavelength_m = 8

[camera]
width_px = 320
height_px = 240
focal_px = 310

[flight]
gsd_m = 0.05
along_overlap = 0.75
across_overlap = 0.6
beyond_area_m = -2
tilt_sigma_deg = 1.0

[truth]
cell_m = 0.1
)";

// Keeps what the run said.
class Listener final : public pipeline::Progress {
 public:
  void note(const std::string& sentence) override { add(notes, sentence); }
  void warn(const std::string& sentence) override { add(warnings, sentence); }
  std::string notes, warnings;

 private:
  void add(std::string& to, const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    to += sentence + "\n";
  }
  std::mutex mutex_;
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << "it said: " << (text)

class HardFlight : public testing::Test {
 protected:
  HardFlight() {
    SerialExecutor executor;
    scene::simulate(scene::parse_scene(kTinyScene, "tiny flight"), folder / "flight", executor);
    testing_support::put_bytes(folder / "hard.toml", "[tiles]\ncells = 64\ncollar_cells = 16\n");
  }

  pipeline::RunRequest request() const {
    pipeline::RunRequest r;
    r.images = folder / "flight" / "images";
    r.poses = folder / "flight" / "poses.csv";
    r.project = folder / "project";
    r.cell_m = 0.1;
    r.dz_m = 0.1;
    r.heights = sweep::HeightRange{-1.5, 1.5};  // without, a dozen photographs are probed for seconds
    r.config = folder / "hard.toml";
    return r;
  }

  pipeline::RunSummary run(const pipeline::RunRequest& request) {
    static const std::atomic<bool> never{false};
    return pipeline::run(request, said, never);
  }

  // The sentence of the error that the run ends with.
  std::string refusal(const pipeline::RunRequest& request, ErrorKind kind) {
    try {
      run(request);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "the run was not refused";
    return {};
  }

  // Rewrites the positions: change(center, number of the photograph).
  void change_positions(const std::function<Vec3d(Vec3d, int)>& change) const {
    const std::string path = (folder / "flight" / "poses.csv").string();
    formats::PoseSet poses = formats::read_poses(path);
    int i = 0;
    for (formats::PosedImage& image : poses.images) image.pose.center = change(image.pose.center, i++);
    formats::write_poses_csv(path, poses.images);
  }

  // Every photograph anew: grey(column, row, number of the photograph).
  void change_photographs(const std::function<int(int, int, int)>& grey) const {
    int i = 0;
    for (const std::string& name : raster::list_photos(folder / "flight" / "images")) {
      Array2d<Rgb8> image(320, 240);
      for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
          const auto value = static_cast<std::uint8_t>(grey(x, y, i));
          image(x, y) = {value, value, value};
        }
      raster::write_image(folder / "flight" / "images" / name, image, 100);
      ++i;
    }
  }

  // Tiles against the truth moved by `origin`: no infinity anywhere, and what share of the mapped cells is right.
  double share_right(const pipeline::RunRequest& request, double tolerance_m) const {
    const pipeline::ProjectPaths paths(request.project);
    const tiles::TileStore store = pipeline::open_store(paths, pipeline::read_project(paths));
    const auto truth = raster::read_float_raster(folder / "flight" / "truth" / "dsm.tif");
    int right = 0, cells = 0, unsound = 0;
    for (const tiles::TileKey key : store.list(0)) {
      const auto tile = store.read(key);
      const Vec2d corner = store.lattice().north_west_corner(key);
      for (int y = 0; y < tile->dem.height(); ++y) {
        for (int x = 0; x < tile->dem.width(); ++x) {
          const float z = tile->dem(x, y), sigma = tile->confidence(x, y);
          const bool measured = tile->mask(x, y) == 1, filled = tile->mask(x, y) == 2;
          unsound += std::isinf(z) || std::isinf(sigma) || measured == std::isnan(sigma);
          unsound += (measured || filled) == std::isnan(z);
          const double east = corner.x + (x + 0.5) * store.lattice().cell_m - request.origin.x;
          const double north = corner.y - (y + 0.5) * store.lattice().cell_m - request.origin.y;
          const Vec2d nw = truth.georeference.north_west_corner;
          const int column = static_cast<int>(std::floor((east - nw.x) / truth.georeference.cell_m));
          const int row = static_cast<int>(std::floor((nw.y - north) / truth.georeference.cell_m));
          if (!truth.values.contains(column, row)) continue;
          ++cells;
          right += std::abs(z - request.origin.z - truth.values(column, row)) <= tolerance_m;
        }
      }
    }
    EXPECT_EQ(unsound, 0);
    return cells > 0 ? static_cast<double>(right) / cells : 0;
  }

  testing_support::TempFolder folder;
  Listener said;
};

struct Place {
  const char* name;
  Vec3d origin;
};
std::ostream& operator<<(std::ostream& out, const Place& place) { return out << place.name; }
class HardPlace : public HardFlight, public testing::WithParamInterface<Place> {};

// Hard: at 10^7 m single precision resolves a metre; around zero truncation and floor part, and the tiles that meet in
// the origin have four different signs; heights change theirs within a tile.
// Bound: 90 % of the mapped area within two GSD, wherever it lies. (Bit for bit: tests/laws/translation_law_test.cpp.)
TEST_P(HardPlace, is_mapped_as_well_as_any_other) {
  pipeline::RunRequest r = request();
  r.origin = GetParam().origin;
  r.heights = sweep::HeightRange{r.origin.z - 1.5, r.origin.z + 1.5};
  run(r);
  EXPECT_GT(share_right(r, 0.12), 0.9);
}
INSTANTIATE_TEST_SUITE_P(Origins, HardPlace,
                         testing::Values(Place{"straddling_the_origin", {-3.3, -2.9, 0}},
                                         Place{"utm_sized", {691203.7, 5334018.2, 512.4}},
                                         Place{"ten_million_metres_and_below_zero", {1e7 + 0.3, -1e7 - 0.7, -431.7}}),
                         [](const auto& i) { return std::string(i.param.name); });

// Hard: one photograph without a fix, at (0, 0), makes the box around all of them as large as a continent; visiting
// its tiles one by one would take for ever. Bound: the run ends, the others' map is as good, and the lone one is named.
TEST_F(HardFlight, a_position_without_a_fix) {
  change_positions([](Vec3d c, int i) { return i == 0 ? Vec3d{0, 0, c.z} : c + Vec3d{691200, 5334016, 0}; });
  pipeline::RunRequest r = request();
  run(r);
  EXPECT_SAYS(said.warnings, "1 of ");
  EXPECT_SAYS(said.warnings, "cannot be matched with them");
  r.origin = {691200, 5334016, 0};
  EXPECT_GT(share_right(r, 0.12), 0.7);  // the corner that the lone one showed has lost a view
}

// Hard: positions of the eastern half in the next UTM zone: numbers that look as good as the others', 600 km away.
// Bound: the run ends and says so; each half is mapped from its own photographs.
TEST_F(HardFlight, across_a_utm_zone_border) {
  change_positions([](Vec3d c, int) { return c + Vec3d{c.x > 3.5 ? 230000.0 : 830000.0, 5334016, 0}; });
  pipeline::RunRequest r = request();
  r.crs = "EPSG:32632";
  const pipeline::RunSummary summary = run(r);
  EXPECT_SAYS(said.warnings, "UTM zone");
  EXPECT_GT(summary.tiles_computed, 0);
  EXPECT_LT(summary.tiles_planned, 100);
}

// Hard: a CRS in feet makes every number wrong by the same factor. Bound: refused before anything is read or written.
TEST_F(HardFlight, feet_are_refused_before_anything_is_made) {
  pipeline::RunRequest r = request();
  r.crs = "EPSG:2225";
  EXPECT_SAYS(refusal(r, ErrorKind::usage), "metres");
  EXPECT_FALSE(std::filesystem::exists(r.project / "project.toml"));
}

// Hard: without a baseline nothing distinguishes the heights. Bound: refused in words; with a given height range the
// run ends with no cell claimed, and says why.
TEST_F(HardFlight, identical_centres_of_projection) {
  change_positions([](Vec3d c, int) { return Vec3d{3.5, 3, c.z}; });
  pipeline::RunRequest r = request();
  r.heights.reset();
  EXPECT_SAYS(refusal(r, ErrorKind::bad_input), "without a baseline no height can be measured");
  r.heights = {-2, 2};
  const pipeline::RunSummary summary = run(r);
  EXPECT_EQ(summary.tiles_empty, summary.tiles_computed);
  EXPECT_SAYS(said.warnings, "not seen by two photographs from different places");
}

struct Picture {
  const char* name;
  std::function<int(int, int, int)> grey;
};
std::ostream& operator<<(std::ostream& out, const Picture& picture) { return out << picture.name; }
class HardPicture : public HardFlight, public testing::WithParamInterface<Picture> {};

int noise(int x, int y, int image) {
  return static_cast<int>(mix64(mix64(static_cast<std::uint64_t>(image) * 100000 + static_cast<std::uint64_t>(y)) +
                                static_cast<std::uint64_t>(x)) &
                          255);
}

// Hard: see images_test.cpp. Bound: refused in words; with a given height range no cell is claimed, and the run says
// why.
TEST_P(HardPicture, maps_nothing_and_says_so) {
  change_photographs(GetParam().grey);
  pipeline::RunRequest r = request();
  r.heights.reset();
  EXPECT_SAYS(refusal(r, ErrorKind::bad_input), "overlap could not be found");
  r.heights = {-2, 2};
  const pipeline::RunSummary summary = run(r);
  EXPECT_EQ(summary.tiles_empty, summary.tiles_computed);
  EXPECT_SAYS(said.warnings, "no surface stands out");
}
INSTANTIATE_TEST_SUITE_P(Pictures, HardPicture,
                         testing::Values(Picture{"all_black", [](int, int, int) { return 0; }},
                                         Picture{"saturated", [](int, int, int) { return 255; }},
                                         Picture{"noise_only", noise}),
                         [](const auto& i) { return std::string(i.param.name); });

// Hard: cells and steps so small that tiles and planes can be neither numbered nor finished.
// Bound: refused within the first seconds with the option named, before anything is made.
TEST_F(HardFlight, lattices_beyond_counting_are_refused) {
  pipeline::RunRequest r = request();
  r.heights = {-2, 2};
  const auto with = [&](double cell, double dz, Vec3d origin) {
    pipeline::RunRequest other = r;
    other.cell_m = cell;
    other.dz_m = dz;
    other.origin = origin;
    return refusal(other, ErrorKind::usage);
  };
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  EXPECT_SAYS(with(1e-6, 0.1, {}), "--cell");
  EXPECT_SAYS(with(kTiny, 0.1, {}), "--cell");
  EXPECT_SAYS(with(0.1, 1e-6, {}), "--dz");
  EXPECT_SAYS(with(0.1, kTiny, {}), "--dz");
  EXPECT_SAYS(with(0.1, 1e-300, {}), "--dz");
  EXPECT_SAYS(with(1e-4, 0.1, {9e8, 0, 0}), "--origin");
  EXPECT_FALSE(std::filesystem::exists(r.project / "project.toml"));
}

// Hard: heights of kilometres with steps of micrometres lie between the numbers of single precision.
// Bound: the run says to what heights are rounded.
TEST_F(HardFlight, steps_finer_than_stored_heights_are_named) {
  pipeline::RunRequest r = request();
  r.heights = {8000 - 0.3, 8000.3};
  r.origin = {0, 0, 8000};
  r.dz_m = 2e-4;
  r.dry_run = true;
  run(r);
  EXPECT_SAYS(said.warnings, "stored to");
  EXPECT_SAYS(said.warnings, "--origin");
}

}  // namespace
}  // namespace skysweep::hard
