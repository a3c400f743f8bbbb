// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "formats/colmap_samples.h"
#include "formats/files.h"

namespace skysweep::formats {
namespace {

class Colmap : public TestFolder {
 protected:
  PoseSet read_text(const std::string& cameras, const std::string& images) const {
    write("model/cameras.txt", cameras);
    write("model/images.txt", images);
    return read_poses(path("model"));
  }
  PoseSet read_binary(const std::string& cameras, const std::string& images) const {
    write("model/cameras.bin", cameras);
    write("model/images.bin", images);
    return read_poses(path("model"));
  }
  std::string refusal(const std::string& cameras, const std::string& images) const {
    return sentence_of([&] { read_text(cameras, images); });
  }
  std::string binary_refusal(const std::string& cameras, const std::string& images) const {
    return sentence_of([&] { read_binary(cameras, images); });
  }
};

// Nadir, north at the top, at (100, 200, 50): half a turn about x, t = -R c.
const std::string kNadir = " 0 1 0 0 -100 200 50 ";
const std::vector<double> kNadirNumbers = {0, 1, 0, 0, -100, 200, 50};
const std::string kPinhole = "1 PINHOLE 2000 1000 1000 1000 1000 500\n";

std::string binary_pinhole() {
  Bytes file;
  add_camera(file.add(std::uint64_t{1}), 1, 1, 2000, 1000, {1000, 1000, 1000, 500});
  return file.text();
}

TEST_F(Colmap, translation_is_minus_rotation_times_center) {
  const PoseSet poses = read_text(kPinhole, "7" + kNadir + "1 a.jpg\n\n");
  EXPECT_EQ(poses.images[0].pose.center, (Vec3d{100, 200, 50}));
  expect_shown_at(poses.images[0], {105, 200, 0}, {1100, 500});
  expect_shown_at(poses.images[0], {100, 205, 0}, {1000, 400});
}

TEST_F(Colmap, every_supported_camera_model_puts_its_parameters_in_place) {
  const PoseSet poses = read_text(
      "# comment\n"
      "1 SIMPLE_PINHOLE 2000 1000 1000 1001 501\n"
      "2 PINHOLE 2000 1000 1000 1100 1001 501\n"
      "3 SIMPLE_RADIAL 2000 1000 1000 1001 501 -0.1\n"
      "4 RADIAL 2000 1000 1000 1001 501 -0.1 0.2\n"
      "5 OPENCV 2000 1000 1000 1100 1001 501 -0.1 0.2 0.01 0.02\n"
      "6 FULL_OPENCV 2000 1000 1000 1100 1001 501 -0.1 0.2 0.01 0.02 0.3 0 0 0\n",
      "1" + kNadir + "1 a\n\n2" + kNadir + "2 b\n\n3" + kNadir + "3 c\n\n4" + kNadir + "4 d\n\n5" + kNadir +
          "5 e\n\n6" + kNadir + "6 f\n\n");
  ASSERT_EQ(poses.images.size(), 6u);
  // Normalised (0.1, 0), r^2 = 0.01.
  const Vec3d east{105, 200, 0}, north{100, 205, 0};
  expect_shown_at(poses.images[0], east, {1101, 501});
  expect_shown_at(poses.images[1], east, {1101, 501});
  expect_shown_at(poses.images[1], north, {1001, 501 - 110});
  expect_shown_at(poses.images[2], east, {1001 + 99.9, 501});
  expect_shown_at(poses.images[3], east, {1001 + 99.902, 501});
  expect_shown_at(poses.images[4], east, {1001 + 99.902 + 0.6, 501 + 0.11});
  expect_shown_at(poses.images[5], east, {1001 + 99.90203 + 0.6, 501 + 0.11});
}

TEST_F(Colmap, second_line_of_an_image_may_be_empty_or_absent_at_the_end) {
  const PoseSet poses = read_text(kPinhole, "# header\n\n1" + kNadir + "1 b.jpg\n\n2" + kNadir +
                                                "1 a.jpg\n10 20 -1 30 40 7\n3" + kNadir + "1 c.jpg");
  ASSERT_EQ(poses.images.size(), 3u);
  EXPECT_EQ(poses.images[0].name, "a.jpg");
  EXPECT_EQ(poses.images[0].where, path("model/images.txt") + ":5");
}

TEST_F(Colmap, image_names_may_hold_spaces_and_folders) {
  const PoseSet poses = read_text(kPinhole, "1" + kNadir + "1 flight 1/my photo.jpg  \r\n\r\n");
  EXPECT_EQ(poses.images[0].name, "flight 1/my photo.jpg");
}

TEST_F(Colmap, binary_equals_text) {
  const std::vector<double> tilted = {0.1, 0.9, -0.3, 0.30, 12.25, -7.5, 300.125};
  const PoseSet text = read_text(
      "4 OPENCV 2000 1000 1000.25 1001.5 990 510 -0.125 0.25 0.0009765625 0.001953125\n"
      "9 SIMPLE_RADIAL 640 480 500 320 240 0.0625\n",
      "1 0.1 0.9 -0.3 0.30 12.25 -7.5 300.125 4 a b.jpg\n1.5 2.5 7\n2" + kNadir + "9 c.jpg\n\n");
  Bytes cameras, images;
  cameras.add(std::uint64_t{2});
  add_camera(cameras, 4, 4, 2000, 1000, {1000.25, 1001.5, 990, 510, -0.125, 0.25, 0.0009765625, 0.001953125});
  add_camera(cameras, 9, 2, 640, 480, {500, 320, 240, 0.0625});
  images.add(std::uint64_t{2});
  add_image(images, 1, tilted, 4, "a b.jpg", 3);
  add_image(images, 2, kNadirNumbers, 9, "c.jpg", 0);
  const PoseSet binary = read_binary(cameras.text(), images.text());
  ASSERT_EQ(binary.notes.size(), 1u);
  EXPECT_SENTENCE(binary.notes[0], "the binary one was read");
  ASSERT_EQ(binary.images.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(binary.images[i].name, text.images[i].name);
    EXPECT_EQ(binary.images[i].model, text.images[i].model);
    EXPECT_EQ(binary.images[i].pose, text.images[i].pose);
  }
  EXPECT_EQ(binary.images[1].where, path("model/images.bin") + ": image 2");
}

TEST_F(Colmap, a_camera_model_that_cannot_be_used_costs_its_images_only) {
  const PoseSet poses =
      read_text(kPinhole +
                    "2 FOV 2000 1000 1000 1000 1000 500 0.9\n3 MAGIC 2000 1000 1\n4 PINHOLE 2000 1000 5\n"
                    "5 PINHOLE 2000 1000 nan 1 1 1\n6 FULL_OPENCV 2000 1000 1 1 1 1 0 0 0 0 0 0.5 0 0\n"
                    "7 PINHOLE 2000 99999999999 1 1 1 1\n",
                "1" + kNadir + "1 a\n\n2" + kNadir + "2 b\n\n3" + kNadir + "3 c\n\n4" + kNadir + "4 d\n\n5" + kNadir +
                    "5 e\n\n6" + kNadir + "6 f\n\n7" + kNadir + "7 g\n\n8" + kNadir + "88 h\n\n");
  ASSERT_EQ(poses.images.size(), 1u);
  ASSERT_EQ(poses.refused.size(), 7u);
  EXPECT_SENTENCE(poses.refused[0].reason, path("model/images.txt") + ":3: its camera cannot be used");
  EXPECT_SENTENCE(poses.refused[0].reason, path("model/cameras.txt") + ":2: the camera model FOV is not supported");
  EXPECT_SENTENCE(poses.refused[1].reason, "cameras.txt:3: the camera model 'MAGIC' is unknown; supported are");
  EXPECT_SENTENCE(poses.refused[2].reason, "cameras.txt:4: the camera model PINHOLE has 4 parameters, but 1");
  EXPECT_SENTENCE(poses.refused[3].reason, "cameras.txt:5: 'nan' is not a finite number");
  EXPECT_SENTENCE(poses.refused[4].reason, "FULL_OPENCV is not supported");
  EXPECT_SENTENCE(poses.refused[5].reason, "is absurd");
  EXPECT_SENTENCE(poses.refused[6].reason, "its camera 88 is not in the model");
}

TEST_F(Colmap, bad_images_cost_only_themselves) {
  const PoseSet poses = read_text(kPinhole, "1" + kNadir + "1 a\n\n2 nan 1 0 0 0 0 0 1 b\n\n3 0 0 0 0 1 2 3 1 c\n\n4" +
                                                kNadir + "1 d\n\n5" + kNadir + "1 d\n\n");
  ASSERT_EQ(poses.images.size(), 1u);
  ASSERT_EQ(poses.refused.size(), 3u);
  EXPECT_SENTENCE(poses.refused[0].reason, "images.txt:3: 'nan' is not a finite number");
  EXPECT_SENTENCE(poses.refused[1].reason, "images.txt:5: the quaternion");
  EXPECT_SENTENCE(poses.refused[2].reason, path("model/images.txt") + ":7 and " + path("model/images.txt") +
                                               ":9: all give a pose for image 'd'");
}

TEST_F(Colmap, a_camera_defined_twice_costs_its_images) {
  EXPECT_SENTENCE(refusal(kPinhole + kPinhole, "1" + kNadir + "1 a\n\n"),
                  "cameras.txt:2: camera 1 is defined more than once");
}

TEST_F(Colmap, a_broken_text_structure_is_refused_with_its_line) {
  EXPECT_SENTENCE(refusal("1 PINHOLE 2000\n", "1" + kNadir + "1 a\n"), "cameras.txt:1: a camera line reads");
  EXPECT_SENTENCE(refusal("one PINHOLE 2000 1000 1\n", ""), "cameras.txt:1: 'one' is not a whole number");
  EXPECT_SENTENCE(refusal(kPinhole, "1 0 1 0 0 1 2\n"), "images.txt:1: an image line reads");
  EXPECT_SENTENCE(refusal(kPinhole, "1" + kNadir + "1 a.jpg\n2" + kNadir + "1 b.jpg\n"),
                  "images.txt:2: the observations of image 'a.jpg' are expected here");
  EXPECT_SENTENCE(refusal(kPinhole, "# nothing\n"), "holds no images");
}

TEST_F(Colmap, a_folder_with_half_a_model_is_refused) {
  write("half/cameras.txt", kPinhole);
  const std::string sentence = sentence_of([&] { read_poses(path("half/cameras.txt")); });
  EXPECT_SENTENCE(sentence, "must both be there");
}

TEST_F(Colmap, a_file_truncated_at_any_byte_is_refused) {
  Bytes images;
  images.add(std::uint64_t{2});
  add_image(images, 1, kNadirNumbers, 1, "a.jpg", 2);
  add_image(images, 2, kNadirNumbers, 1, "b.jpg", 0);
  const std::string whole = images.text();
  EXPECT_EQ(read_binary(binary_pinhole(), whole).images.size(), 2u);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_SENTENCE(binary_refusal(binary_pinhole(), whole.substr(0, length)), "truncated")
        << "after " << length << " bytes";
  EXPECT_SENTENCE(binary_refusal(binary_pinhole(), whole + "x"), "goes on for 1 bytes");
  for (std::size_t length = 0; length < binary_pinhole().size(); ++length)
    EXPECT_SENTENCE(binary_refusal(binary_pinhole().substr(0, length), whole), "cameras.bin");
}

TEST_F(Colmap, absurd_counts_are_refused_before_anything_is_allocated) {
  for (const std::uint64_t count : {std::uint64_t{1000}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    Bytes cameras;
    add_camera(cameras.add(count), 1, 1, 2000, 1000, {1000, 1000, 1000, 500});
    EXPECT_SENTENCE(binary_refusal(cameras.text(), ""), "cameras, but the file has room for");
    Bytes images;
    add_image(images.add(std::uint64_t{1}), 1, kNadirNumbers, 1, "a.jpg", 0);
    std::string text = images.text();
    text.replace(text.size() - 8, 8, reinterpret_cast<const char*>(&count), 8);
    EXPECT_SENTENCE(binary_refusal(binary_pinhole(), text),
                    "image 1: claims " + std::to_string(count) + " observations");
  }
}

TEST_F(Colmap, an_unknown_model_number_is_refused) {
  Bytes cameras;
  add_camera(cameras.add(std::uint64_t{1}), 1, 77, 2000, 1000, {1000});
  EXPECT_SENTENCE(binary_refusal(cameras.text(), ""), "camera 1: the camera model number 77 is unknown");
}

TEST_F(Colmap, numbers_that_are_not_finite_in_a_binary_model_cost_their_image) {
  Bytes images;
  images.add(std::uint64_t{2});
  add_image(images, 1, {0, 1, 0, 0, NAN, 0, 0}, 1, "a.jpg", 0);
  add_image(images, 2, kNadirNumbers, 1, "b.jpg", 0);
  const PoseSet poses = read_binary(binary_pinhole(), images.text());
  EXPECT_EQ(poses.images.size(), 1u);
  ASSERT_EQ(poses.refused.size(), 1u);
  EXPECT_SENTENCE(poses.refused[0].reason, "images.bin: image 1: the pose cannot be used: the position is not finite");
}

}  // namespace
}  // namespace skysweep::formats
