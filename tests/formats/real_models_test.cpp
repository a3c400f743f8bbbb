// SPDX-License-Identifier: Apache-2.0
// Two reconstructions of real flights: our cameras must show their points where COLMAP saw them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "formats/check_points.h"
#include "formats/files.h"

namespace skysweep::formats {
namespace {

struct RealModel {
  const char* folder;
  std::size_t images;
  std::size_t points;
  double reprojection_error_px;  // mean over the observations, from the bundle adjustment that made the model
};

std::ostream& operator<<(std::ostream& out, const RealModel& model) { return out << model.folder; }

class RealModels : public testing::TestWithParam<RealModel> {};

struct Observation {
  std::string point_id;
  Vec2d pixel;
};

// Observations by image name, read without the reader under test.
std::map<std::string, std::vector<Observation>> observations(const std::string& path) {
  std::map<std::string, std::vector<Observation>> all;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream image(line);
    std::string word, name;
    while (image >> word) name = word;
    std::getline(file, line);
    std::istringstream points(line);
    Vec2d pixel;
    while (points >> pixel.x >> pixel.y >> word)
      if (word != "-1") all[name].push_back({word, pixel});
  }
  return all;
}

TEST_P(RealModels, points_are_shown_where_they_were_observed) {
  const char* data = std::getenv("SKYSWEEP_DATA");
  if (!data) GTEST_SKIP() << "SKYSWEEP_DATA does not name a folder with real reconstructions";
  const std::string folder = std::string(data) + "/" + GetParam().folder + "/sparse";
  const PoseSet poses = read_poses(folder);
  EXPECT_EQ(poses.images.size(), GetParam().images);
  EXPECT_TRUE(poses.refused.empty());
  std::map<std::string, Vec3d> points;
  for (const CheckPoint& point : read_check_points(folder)) points[point.id] = point.position;
  EXPECT_EQ(points.size(), GetParam().points);

  double sum = 0;
  int count = 0;
  for (const auto& [name, seen] : observations(folder + "/images.txt")) {
    const PosedImage& image = image_named(poses, name);
    const camera::Camera camera(image.model, image.pose);
    for (const auto& [id, pixel] : seen) {
      const auto shown = camera.project(points.at(id));
      ASSERT_TRUE(shown.has_value());
      sum += norm(*shown - pixel);
      ++count;
    }
  }
  // The model's files give observations to 0.01 px.
  EXPECT_NEAR(sum / count, GetParam().reprojection_error_px, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Flights, RealModels,
                         testing::Values(RealModel{"brighton_beach", 18, 4967, 0.441},
                                         RealModel{"mirafiori", 32, 20399, 0.532}));

}  // namespace
}  // namespace skysweep::formats
