// SPDX-License-Identifier: Apache-2.0
// The export command from outside: words, refusals, what is left behind. What the formats hold: tests/export.
#include <sstream>

#include "app/simulated_flight.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::names_in;
using testing_support::put_bytes;

class Export : public SimulatedFlight {
 protected:
  // A map with a place on Earth.
  void make_map() { ASSERT_EQ(run({"--crs=EPSG:32632", "--origin=691200,5334016,0"}).exit_code, 0); }

  Outcome exported(const std::string& name, const Arguments& more, const std::string& project_name = "project") const {
    Arguments all = {"export", project(project_name), "-o", folder / name};
    all.insert(all.end(), more.begin(), more.end());
    return skysweep(all);
  }
};

TEST_F(Export, every_format_and_layer_is_written_and_named) {
  make_map();
  const std::string before = file_bytes(project() / "project.toml");
  const std::map<std::string, Arguments> wanted = {
      {"dsm.tif", {"--format=cog"}},
      {"ortho.tif", {"--format=cog", "--layer=ortho", "--crs=EPSG:4326"}},
      {"sigma.tif", {"--format=cog", "--layer=confidence", "--cell=0.25", "--resampling=cubic"}},
      {"mask.tif", {"--format=cog", "--layer=mask", "--aoi=691196,5334012,691204,5334020"}},
      {"relief.tif", {"--format=cog", "--layer=relief", "--relief-range=-1,3"}},
      {"shade.tif", {"--format=cog", "--layer=hillshade"}},
      {"tiles", {"--format=geotiff-tiles", "--tile-cells=32", "--overlap=2"}},
      {"web", {"--format=web-tiles", "--layer=ortho", "--encoding=webp", "--quality=70"}},
      {"heights", {"--format=web-tiles", "--encoding=terrain-rgb", "--zoom=17-19", "--scheme=tms"}},
      {"map.mbtiles", {"--format=mbtiles", "--layer=relief", "--encoding=jpeg"}},
      {"dsm.asc", {"--format=ascii-grid", "--resolution=0.5"}},
      {"dsm.xyz", {"--format=xyz-text"}},
      {"map.exr", {"--format=exr"}}};
  for (const auto& [name, options] : wanted) {
    const Outcome outcome = exported(name, options);
    EXPECT_EQ(outcome.exit_code, 0) << name << ": " << outcome.err;
    EXPECT_TRUE(fs::exists(folder / name)) << name;
    EXPECT_TRUE(says(outcome.out, {name, "CRS: WGS 84"})) << name;
  }
  EXPECT_TRUE(fs::exists(folder / "heights/19"));
  EXPECT_FALSE(fs::exists(folder / "heights/20"));
  EXPECT_TRUE(says(exported("white.mbtiles", {"--format=mbtiles", "--layer=ortho", "--encoding=jpeg"}).err, {"white"}));
  for (const std::string& name : names_in(folder.path()))
    EXPECT_EQ(name.find("skysweep-part"), std::string::npos) << name;
  EXPECT_EQ(file_bytes(project() / "project.toml"), before);
}

TEST_F(Export, wrong_words_are_usage_errors_that_say_what_to_change) {
  make_map();
  struct Case {
    Arguments options;
    std::vector<std::string> words;
  };
  const std::vector<Case> cases = {
      {{"--format=cgo"}, {"--format", "did you mean cog?"}},
      {{"--format=cog", "--layer=hilshade"}, {"--layer", "did you mean hillshade?"}},
      {{"--format=cog", "--cell=0.2", "--resampling=cubc"}, {"--resampling", "did you mean cubic?"}},
      {{"--format=web-tiles", "--encoding=terarium"}, {"--encoding", "did you mean terrarium?"}},
      {{"--format=web-tiles", "--scheme=tsm"}, {"--scheme", "did you mean tms?"}},
      {{"--format=cog", "--aoi=1,2,3"}, {"--aoi"}},
      {{"--format=cog", "--crs=EPSG:1"}, {"EPSG:1"}},
      {{"--format=cog", "--crs=EPSG:25832+7837"}, {"heights are not converted"}},
      {{"--format=cog", "--cell=0"}, {"--cell"}},
      {{"--format=cog", "--resampling=cubic"}, {"--resampling has no effect"}},
      {{"--format=cog", "--layer=mask", "--cell=0.2", "--resampling=average"}, {"mask is nearest"}},
      {{"--format=cog", "--relief-range=1,2"}, {"--layer relief"}},
      {{"--format=cog", "--layer=relief", "--relief-range=2,1"}, {"LOW below HIGH"}},
      {{"--format=cog", "--layer=relief", "--relief-range=2"}, {"--relief-range takes"}},
      {{"--format=cog", "--zoom=17"}, {"--zoom has no effect"}},
      {{"--format=cog", "--tile-cells=64"}, {"--tile-cells has no effect"}},
      {{"--format=cog", "--overlap=1"}, {"--overlap has no effect"}},
      {{"--format=cog", "--quality=50"}, {"--quality has no effect"}},
      {{"--format=mbtiles", "--scheme=tms"}, {"--scheme has no effect"}},
      {{"--format=exr", "--layer=dsm"}, {"--layer has no effect"}},
      {{"--format=web-tiles", "--cell=1"}, {"--cell has no effect"}},
      {{"--format=web-tiles", "--crs=EPSG:4326"}, {"--crs has no effect"}},
      {{"--format=geotiff-tiles", "--tile-cells=1"}, {"--tile-cells takes"}},
      {{"--format=geotiff-tiles", "--overlap=-1"}, {"--overlap takes"}},
      {{"--format=web-tiles", "--zoom=20-17"}, {"--zoom takes"}},
      {{"--format=web-tiles", "--zoom=17-99"}, {"--zoom takes"}},
      {{"--format=web-tiles", "--zoom=high"}, {"--zoom takes"}},
      {{"--format=web-tiles", "--encoding=png"}, {"is for pictures", "terrarium"}},
      {{"--format=web-tiles", "--layer=ortho", "--encoding=terrarium"}, {"is for heights", "png"}},
      {{"--format=web-tiles", "--layer=confidence", "--encoding=terrarium"}, {"float32"}},
      {{"--format=web-tiles", "--layer=mask"}, {"mask holds codes"}},
      {{"--format=web-tiles", "--layer=ortho", "--quality=50"}, {"--quality has an effect"}},
      {{"--format=web-tiles", "--layer=ortho", "--encoding=jpeg", "--quality=0"}, {"1 to 100"}},
      {{"--format=mbtiles", "--encoding=float32"}, {"terrarium"}},
      {{"--format=ascii-grid", "--layer=ortho"}, {"--layer dsm"}},
      {{"--format=xyz-text", "--layer=relief"}, {"--layer dsm"}},
  };
  for (const Case& c : cases) {
    const Outcome outcome = exported("out", c.options);
    EXPECT_EQ(outcome.exit_code, 2) << c.options.back();
    EXPECT_TRUE(says(outcome.err, c.words)) << c.options.back();
    EXPECT_FALSE(fs::exists(folder / "out")) << c.options.back();
  }
  EXPECT_EQ(exported("out", {"--format=cog", "--aoi=0,0,1,1"}).exit_code, 3);
  EXPECT_EQ(exported("out", {"--format=cog"}, "nowhere").exit_code, 3);
}

TEST_F(Export, a_local_frame_has_no_web_tiles_and_no_other_crs) {
  ASSERT_EQ(run().exit_code, 0);
  for (const Arguments& options : {Arguments{"--format=web-tiles"}, Arguments{"--format=mbtiles", "--layer=ortho"},
                                   Arguments{"--format=cog", "--crs=EPSG:32632"}}) {
    const Outcome outcome = exported("out", options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, {"local metric frame", "run --crs"}));
  }
  EXPECT_EQ(exported("dsm.tif", {"--format=cog", "--cell=0.3"}).exit_code, 0);
  EXPECT_EQ(exported("dsm.asc", {"--format=ascii-grid"}).exit_code, 0);
}

TEST_F(Export, machines_get_one_json_object_a_line) {
  ASSERT_EQ(run().exit_code, 0);
  const Outcome outcome = exported("dsm.tif", {"--format=cog", "--json-log"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  double done = 0;
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json event = nlohmann::json::parse(line);
    if (event.at("event") == "progress") done = event.at("done").get<double>() / event.at("total").get<double>();
  }
  EXPECT_EQ(done, 1);
}

TEST_F(Export, nothing_is_replaced_without_being_asked) {
  ASSERT_EQ(run().exit_code, 0);
  put_bytes(folder / "map.tif", "mine");
  const Outcome refused = exported("map.tif", {"--format=cog"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(says(refused.err, {"map.tif", "--overwrite"}));
  EXPECT_EQ(file_bytes(folder / "map.tif"), "mine");
  EXPECT_EQ(exported("map.tif", {"--format=cog", "--overwrite"}).exit_code, 0);
  EXPECT_GT(fs::file_size(folder / "map.tif"), 1000u);
  // The folder of photographs is no export.
  EXPECT_EQ(exported("images", {"--format=geotiff-tiles", "--overwrite"}).exit_code, 2);
  EXPECT_TRUE(fs::exists(photo("0001.jpg")));
}

TEST_F(Export, a_full_disk_leaves_nothing_under_the_final_name) {
  make_map();
  for (const Arguments& format : {Arguments{"--format=cog", "--layer=ortho"}, Arguments{"--format=xyz-text"},
                                  Arguments{"--format=mbtiles", "--layer=ortho"}, Arguments{"--format=exr"},
                                  Arguments{"--format=ascii-grid"}, Arguments{"--format=web-tiles", "--layer=ortho"}}) {
    Arguments all = {"export", project(), "-o", folder / "out"};
    all.insert(all.end(), format.begin(), format.end());
    Process process(all, 4096);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 1) << format.front() << outcome.err;
    EXPECT_TRUE(says(outcome.err, {"cannot write"})) << format.front();
    EXPECT_FALSE(fs::exists(folder / "out")) << format.front();
  }
}

}  // namespace
}  // namespace skysweep::app_test
