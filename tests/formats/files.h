// SPDX-License-Identifier: Apache-2.0
// What the tests of the pose formats share: files in a folder of their own, and sentences of errors.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "camera/camera.h"
#include "core/error.h"
#include "formats/pose_set.h"

namespace skysweep::formats {

// A folder that no other test uses; it goes when the test ends.
class TestFolder : public testing::Test {
 protected:
  TestFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("formats_") + test->test_suite_name() + "_" +
                                                           test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~TestFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Writes the file and gives back its path.
  std::string write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return path(name);
  }

  std::filesystem::path folder_;
};

// The sentence of the Error(bad_input) that `call` throws; a failed test if it throws none.
template <typename Call>
std::string sentence_of(Call&& call, ErrorKind kind = ErrorKind::bad_input) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

#define EXPECT_SENTENCE(text, part) EXPECT_TRUE(contains(text, part)) << "the sentence was: " << (text)

inline const PosedImage& image_named(const PoseSet& poses, const std::string& name) {
  for (const PosedImage& image : poses.images)
    if (image.name == name) return image;
  ADD_FAILURE() << "no image " << name;
  static const PosedImage none;
  return none;
}

// Where the image shows the world point.
inline void expect_shown_at(const PosedImage& image, Vec3d world, Vec2d pixel, double tolerance = 1e-6) {
  ASSERT_FALSE(image.model.problem());
  const auto shown = camera::Camera(image.model, image.pose).project(world);
  ASSERT_TRUE(shown.has_value());
  EXPECT_NEAR(shown->x, pixel.x, tolerance) << image.name;
  EXPECT_NEAR(shown->y, pixel.y, tolerance) << image.name;
}

}  // namespace skysweep::formats
