// SPDX-License-Identifier: Apache-2.0
// The render command from outside: that each option changes the picture, refusals, what is left behind. What pictures
// show: tests/render.
#include <chrono>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "app/simulated_flight.h"
#include "raster/exr.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;
using testing_support::file_bytes;
using testing_support::names_in;

class Render : public SimulatedFlight {
 protected:
  void SetUp() override { ASSERT_EQ(run().exit_code, 0); }

  Outcome rendered(const std::string& name, const Arguments& more) const {
    Arguments all = {"render", project(), "-o", folder / name, "--size=160x100"};
    all.insert(all.end(), more.begin(), more.end());
    return skysweep(all);
  }

  // The bytes of the picture made with these options.
  std::string picture(const Arguments& more) const {
    const Outcome outcome = rendered("picture.png", more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file_bytes(folder / "picture.png");
  }
};

TEST_F(Render, every_option_changes_the_picture_and_threads_do_not) {
  const auto with = [&](const Arguments& more, const std::string& size = "300x200") {
    Arguments all = {"render", project(), "-o", folder / "relief.png", "--look=relief", "--size=" + size};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = skysweep(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file_bytes(folder / "relief.png");
  };
  const std::string plain = with({});
  EXPECT_TRUE(with({"--threads=1"}) == plain);
  for (const Arguments& option : std::vector<Arguments>{{"--view=north"},
                                                        {"--view=top"},
                                                        {"--view=oblique"},
                                                        {"--eye=2,-20,15", "--target=4,4,0"},
                                                        {"--fov=20"},
                                                        {"--orthographic"},
                                                        {"--sun=80,20"},
                                                        {"--exaggeration=3"},
                                                        {"--relief-range=-5,20"},
                                                        {"--surface=boxes"},
                                                        {"--samples=1"},
                                                        {"--background=ff0000"},
                                                        {"--no-legend"}})
    EXPECT_TRUE(with(option) != plain) << option.front();
  EXPECT_TRUE(with({"--exact"}, "24x16") != with({}, "24x16"));
  EXPECT_TRUE(with({"--sun=80,20", "--shadows"}) != with({"--sun=80,20"}));
  const Arguments look_down = {"--eye=2,-20,15", "--target=4,4,0"};
  EXPECT_TRUE(with({look_down[0], look_down[1], "--fov=20"}) != with(look_down));
  EXPECT_TRUE(with({look_down[0], look_down[1], "--orthographic"}) != with(look_down));
}

TEST_F(Render, looks_differ_and_kinds_of_files_hold_the_same_picture) {
  std::map<std::string, std::string> looks;
  for (const char* look : {"orthophoto", "hillshade", "relief", "slope", "confidence", "views", "level"}) {
    const std::string bytes = picture({std::string("--look=") + look});
    for (const auto& [other, others] : looks) EXPECT_TRUE(bytes != others) << look << " " << other;
    looks[look] = bytes;
  }
  const auto read = [&](const std::string& name) { return cv::imread((folder / name).string(), cv::IMREAD_COLOR); };
  EXPECT_EQ(rendered("a.webp", {"--quality=100"}).exit_code, 0);
  EXPECT_EQ(rendered("b.jpg", {"--quality=95"}).exit_code, 0);
  EXPECT_EQ(rendered("c.jpg", {"--quality=20"}).exit_code, 0);
  EXPECT_EQ(rendered("picture.png", {}).exit_code, 0);
  const cv::Mat png = read("picture.png"), webp = read("a.webp"), jpeg = read("b.jpg");
  ASSERT_EQ(png.size(), cv::Size(160, 100));
  EXPECT_EQ(cv::norm(png, webp, cv::NORM_INF), 0);
  EXPECT_LT(cv::norm(png, jpeg, cv::NORM_L1) / (160 * 100 * 3), 6);
  EXPECT_LT(fs::file_size(folder / "c.jpg"), fs::file_size(folder / "b.jpg"));
}

TEST_F(Render, a_device_casts_the_rays_if_asked_to_and_draws_the_same_picture) {
  ASSERT_EQ(rendered("cpu.png", {"--look=relief", "--backend=cpu"}).exit_code, 0);
  const Outcome outcome = rendered("gpu.png", {"--look=relief", "--backend=gpu"});
  if (outcome.exit_code != 0) {
    EXPECT_TRUE(says(outcome.err, {"--backend cpu"}));
    GTEST_SKIP() << outcome.err;
  }
  EXPECT_TRUE(says(outcome.out + outcome.err, {"Rays are cast by"}));
  const cv::Mat a = cv::imread((folder / "cpu.png").string(), cv::IMREAD_COLOR);
  const cv::Mat b = cv::imread((folder / "gpu.png").string(), cv::IMREAD_COLOR);
  EXPECT_LT(cv::norm(a, b, cv::NORM_L1) / (160 * 100 * 3), 0.01);
}

TEST_F(Render, openexr_holds_layers_in_map_coordinates) {
  ASSERT_EQ(rendered("layers.exr", {"--view=top"}).exit_code, 0);
  const raster::ExrImage image = raster::read_exr(folder / "layers.exr");
  for (const char* name :
       {"R", "G", "B", "Z", "position.X", "position.Y", "position.Z", "normal.X", "normal.Y", "normal.Z", "level"})
    ASSERT_TRUE(image.channels.contains(name)) << name;
  const float height = image.channels.at("position.Z")(80, 50);
  EXPECT_TRUE(std::isfinite(height));
  EXPECT_GT(image.channels.at("Z")(80, 50), 100);
  EXPECT_FALSE(image.labels.at("origin").empty());
  EXPECT_FALSE(image.labels.at("crs").empty());
}

TEST_F(Render, little_memory_draws_a_coarser_level_and_too_little_is_refused) {
  const Arguments top = {"--view=top", "--look=level", "--no-legend"};
  const Outcome fine = rendered("picture.png", top);
  EXPECT_TRUE(says(fine.out, {"level 0"}));
  Arguments small = top;
  small.push_back("--memory=322MiB");
  const Outcome coarse = rendered("coarse.png", small);
  EXPECT_EQ(coarse.exit_code, 0) << coarse.err;
  EXPECT_FALSE(says(coarse.out, {"level 0"})) << coarse.out;
  EXPECT_TRUE(file_bytes(folder / "coarse.png") != file_bytes(folder / "picture.png"));
  const Outcome none = rendered("none.png", {"--memory=100MiB"});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_TRUE(says(none.err, {"--memory"}));
}

TEST_F(Render, an_area_is_cut_out) {
  EXPECT_TRUE(picture({"--view=top", "--aoi=0,0,3,3"}) != picture({"--view=top"}));
  EXPECT_EQ(rendered("none.png", {"--aoi=5000,5000,5010,5010"}).exit_code, 3);
}

TEST_F(Render, wrong_words_are_usage_errors_that_say_what_to_change) {
  struct Case {
    Arguments options;
    std::vector<std::string> words;
  };
  const std::vector<Case> cases = {
      {{"--look=hilshade"}, {"--look", "did you mean hillshade?"}},
      {{"--view=tob"}, {"--view", "did you mean top?"}},
      {{"--surface=boxs"}, {"--surface", "did you mean boxes?"}},
      {{"--eye=1,2,3"}, {"--target"}},
      {{"--eye=1,2", "--target=1,2,3"}, {"--eye takes E,N,H"}},
      {{"--eye=1,2,3", "--target=1,2,3"}, {"same place"}},
      {{"--view=top", "--photo=a.jpg"}, {"one of them"}},
      {{"--photo=none.jpg"}, {"no photograph 'none.jpg'"}},
      {{"--fov=180"}, {"--fov"}},
      {{"--view=top", "--fov=30"}, {"--fov has no effect"}},
      {{"--orthographic", "--fov=30"}, {"--fov has no effect"}},
      {{"--view=oblique", "--orthographic"}, {"--orthographic has no effect"}},
      {{"--sun=10"}, {"--sun takes"}},
      {{"--sun=10,0"}, {"elevation"}},
      {{"--exaggeration=0"}, {"--exaggeration"}},
      {{"--relief-range=1,2"}, {"--relief-range has no effect"}},
      {{"--look=relief", "--relief-range=2,1"}, {"LOW below HIGH"}},
      {{"--no-legend"}, {"--no-legend has no effect"}},
      {{"--samples=9"}, {"--samples"}},
      {{"--quality=50"}, {"--quality has no effect"}},
      {{"--background=green"}, {"RRGGBB"}},
      {{"--threads=0"}, {"--threads"}},
      {{"--backend=gpo"}, {"--backend", "did you mean gpu?"}},
      {{"--aoi=1,2,3"}, {"--aoi"}},
      {{"--memory=much"}, {"--memory"}},
  };
  for (const Case& c : cases) {
    const Outcome outcome = rendered("wrong.png", c.options);
    EXPECT_EQ(outcome.exit_code, 2) << c.options.front();
    EXPECT_TRUE(says(outcome.err, c.words)) << outcome.err;
  }
  const Outcome ending = rendered("wrong.gif", {});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_TRUE(says(ending.err, {".png", ".exr"}));
  const Outcome size = skysweep({"render", project(), "-o", folder / "wrong.png", "--size=10x900000"});
  EXPECT_EQ(size.exit_code, 2);
  EXPECT_TRUE(says(size.err, {"--size takes WIDTHxHEIGHT"}));
  EXPECT_EQ(skysweep({"render", folder / "nothing", "-o", folder / "wrong.png"}).exit_code, 3);
  EXPECT_FALSE(fs::exists(folder / "wrong.png"));
}

TEST_F(Render, an_interrupted_picture_is_not_written) {
  Process process({"render", project(), "-o", folder / "large.png", "--size=8000x8000", "--samples=8", "--json-log"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // minutes of work, less than a second to their start
  ASSERT_TRUE(process.is_running());
  process.interrupt();
  const Outcome outcome = process.wait();
  if (outcome.exit_code != -1) {  // else a busy machine had not brought it to where it listens
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_TRUE(says(outcome.out + outcome.err, {"Nothing was written"}));
  }
  EXPECT_FALSE(fs::exists(folder / "large.png"));
}

// The map seen from a photograph's own camera is that photograph, where the map has what it shows.
TEST_F(Render, a_photographs_own_view_gives_the_photograph_back) {
  const std::string name = names_in(images()).front();
  const cv::Mat photograph = pixels_of(name);
  ASSERT_EQ(
      skysweep({"render", project(), "-o", folder / "view.png", "--photo=" + name, "--background=ff00ff"}).exit_code,
      0);
  const cv::Mat view = cv::imread((folder / "view.png").string(), cv::IMREAD_COLOR);
  ASSERT_EQ(view.size(), photograph.size());
  const auto psnr_shifted = [&](int shift) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < view.rows; ++y)
      for (int x = 0; x + shift < view.cols; ++x) {
        const cv::Vec3b a = view.at<cv::Vec3b>(y, x), b = photograph.at<cv::Vec3b>(y, x + shift);
        if (a == cv::Vec3b(255, 0, 255)) continue;
        for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]), ++count;
      }
    EXPECT_GT(count, view.rows * view.cols);
    return 10 * std::log10(255 * 255 / (sum / count));
  };
  RecordProperty("psnr_db", std::to_string(psnr_shifted(0)));
  EXPECT_GT(psnr_shifted(0), 25);
  EXPECT_GT(psnr_shifted(0), psnr_shifted(3) + 1);
  EXPECT_EQ(rendered("view.png", {"--photo=" + name}).exit_code, 2);  // 160x100 is not its shape
  EXPECT_EQ(rendered("view.png", {"--photo=" + name, "--exaggeration=2"}).exit_code, 2);
}

}  // namespace
}  // namespace skysweep::app_test
