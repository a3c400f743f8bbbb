// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace skysweep::index {
namespace {

namespace fs = std::filesystem;

const std::string kUtm =
    R"(PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]],)"
    R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],)"
    R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],)"
    R"(UNIT["metre",1],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","32632"]])";
const std::string kLocal =
    R"(ENGCRS["a field behind the house",EDATUM["unknown"],CS[Cartesian,3],AXIS["easting",east],)"
    R"(AXIS["northing",north],AXIS["up",up],LENGTHUNIT["metre",1]])";

// A folder of its own for each test.
class CatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("catalogue_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path path() const { return folder_ / "catalog.gpkg"; }

  fs::path folder_;
};

ImageRecord random_image(const std::string& name, Random& random) {
  ImageRecord image;
  image.name = name;
  image.model = {5472,   3648,   3600 + random.uniform(),         3601 + random.uniform(),
                 2736.1, 1824.9, {-0.1, 0.02, 1e-4, -2e-5, 0.003}};
  image.pose = {
      camera::rotation_from_yaw_pitch_roll(random.uniform(-180, 180), random.uniform(-90, -60), random.uniform(-3, 3)),
      camera::snap_position({random.uniform(4e5, 6e5), random.uniform(-1e7, 1e7), random.uniform(50, 900)})};
  image.view_class = camera::ViewClass::near_vertical;
  const camera::Camera camera(image.model, image.pose);
  image.footprint = camera::footprint(camera, 0, 0, 1e4);
  image.content_digest = "xxh3:" + std::to_string(random.next());
  image.file_bytes = 8'123'456'789;
  image.stamp = "8123456789 1.5 1.25 " + std::to_string(random.next());
  return image;
}

TileRecord some_tile(const std::string& name) {
  return {name,
          0,
          {{512'000.2, -51.2}, {512'051.4, 0.1}},
          "xxh3:77",
          {"DJI_1.jpg", "DJI_2.jpg"},
          0.987654321,
          -3.25,
          41.1,
          1.0 / 3,
          "candidates",
          {"ab-cd", "ef-01"},
          "checksum",
          "stamp"};
}

void expect_equal(const ImageRecord& a, const ImageRecord& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.model, b.model) << a.name;
  EXPECT_EQ(a.pose, b.pose) << a.name;
  EXPECT_EQ(a.view_class, b.view_class) << a.name;
  EXPECT_EQ(a.footprint, b.footprint) << a.name;
  EXPECT_EQ(a.status, b.status) << a.name;
  EXPECT_EQ(a.reason, b.reason) << a.name;
  EXPECT_EQ(a.content_digest, b.content_digest) << a.name;
  EXPECT_EQ(a.file_bytes, b.file_bytes) << a.name;
  EXPECT_EQ(a.stamp, b.stamp) << a.name;
  EXPECT_EQ(a, b) << a.name;
}

void expect_equal(const TileRecord& a, const TileRecord& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.extent, b.extent);
  EXPECT_EQ(a.input_digest, b.input_digest);
  EXPECT_EQ(a.views, b.views);
  EXPECT_EQ(a.valid_share, b.valid_share);
  EXPECT_EQ(a.z_low, b.z_low);
  EXPECT_EQ(a.z_high, b.z_high);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a, b) << "candidates_digest, view_digests, checksum or stamp";
}

template <typename Record>
void expect_equal(const std::vector<Record>& a, const std::vector<Record>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_equal(a[i], b[i]);
}

// The message and kind of the Error that `action` throws.
template <typename Action>
std::pair<std::string, ErrorKind> error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.what(), error.kind()};
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  for (char line[512]; fgets(line, sizeof line, pipe);) text += line;
  EXPECT_EQ(pclose(pipe), 0) << text;
  return text;
}

// While one lives, no file of this process grows beyond a size: the nearest that a test gets to a full disk.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t largest_file) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{static_cast<rlim_t>(largest_file), old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

TEST_F(CatalogueTest, gives_back_every_image_bit_for_bit_after_reopening) {
  Random random(51);
  std::vector<ImageRecord> images;
  for (int i = 0; i < 50; ++i) images.push_back(random_image("a/IMG_" + std::to_string(100 + i) + ".jpg", random));
  images[3].status = ImageStatus::oblique;
  images[3].reason = "50 degrees from nadir, more than 40";
  images[3].view_class = camera::ViewClass::high_oblique;
  images[5].status = ImageStatus::removed;
  images[4].pose.cam_from_world.m[1] = 0.1 + 0.2;  // not quite a rotation any more: still nobody may round it
  { Catalogue(path(), kUtm).put_images(images); }
  expect_equal(Catalogue(path(), kUtm).images(), images);
}

TEST_F(CatalogueTest, gives_back_every_tile_after_reopening) {
  std::vector<TileRecord> tiles = {some_tile("l0x-7y4"), some_tile("l3x0y0"), some_tile("top")};
  tiles[1].level = 3;
  tiles[2].views.clear();
  { Catalogue(path(), kUtm).put_tiles(tiles); }
  expect_equal(Catalogue(path(), kUtm).tiles(), tiles);
}

TEST_F(CatalogueTest, keeps_what_the_products_were_made_from) {
  Catalogue catalogue(path(), kUtm);
  catalogue.put_products({{"ortho", "d1", "s1"}, {"dsm", "d1", "s2"}});
  catalogue.put_products({{"dsm", "d2", "s3"}});
  ASSERT_EQ(catalogue.products().size(), 2u);
  EXPECT_EQ(catalogue.products()[0].digest, "d2");
  EXPECT_EQ(catalogue.products()[0].stamp, "s3");
  catalogue.remove_products({"dsm", "none"});
  EXPECT_EQ(catalogue.products().size(), 1u);
}

TEST_F(CatalogueTest, looking_changes_no_byte_and_makes_no_file) {
  Random random(62);
  Catalogue(path(), kUtm).put_images({random_image("a", random)});
  const auto bytes = [&] {
    std::ifstream in(path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string before = bytes();
  EXPECT_EQ(Catalogue::open_existing(path()).images().size(), 1u);
  EXPECT_EQ(Catalogue(path(), kUtm).images().size(), 1u);
  EXPECT_TRUE(bytes() == before);
  EXPECT_EQ(error_of([&] { Catalogue::open_existing(folder_ / "none.gpkg"); }).second, ErrorKind::bad_input);
  EXPECT_FALSE(fs::exists(folder_ / "none.gpkg"));
}

TEST_F(CatalogueTest, sorts_by_name_whatever_the_order_of_arrival) {
  Random random(52);
  Catalogue catalogue(path(), kUtm);
  for (const char* name : {"c", "a", "B", "b"}) catalogue.put_images({random_image(name, random)});
  std::vector<std::string> names;
  for (const ImageRecord& image : catalogue.images()) names.push_back(image.name);
  EXPECT_EQ(names, (std::vector<std::string>{"B", "a", "b", "c"}));
}

TEST_F(CatalogueTest, keeps_names_with_quotes_unicode_and_newlines) {
  Random random(53);
  const std::vector<std::string> names = {"line\nbreak.jpg", "o'brien's \"best\".jpg",
                                          "semi;colon -- '); DROP TABLE images", "tab\tand \\backslash",
                                          "\xc3\x9c"
                                          "bersicht/\xe6\x97\xa5\xe6\x9c\xac.jpg"};
  std::vector<ImageRecord> images;
  for (const std::string& name : names) images.push_back(random_image(name, random));
  images[0].reason = "it's \"odd\"\nin every way";
  TileRecord tile = some_tile("l0x0y0");
  tile.views = names;
  {
    Catalogue catalogue(path(), kUtm);
    catalogue.put_images(images);
    catalogue.put_images(images);  // found again under the same names
    catalogue.put_tiles({tile});
  }
  Catalogue catalogue(path(), kUtm);
  expect_equal(catalogue.images(), images);
  expect_equal(catalogue.tiles(), {tile});
  catalogue.remove_images(names);
  EXPECT_TRUE(catalogue.images().empty());
}

TEST_F(CatalogueTest, a_record_replaces_that_of_the_same_name_altogether) {
  Random random(54);
  Catalogue catalogue(path(), kUtm);
  const ImageRecord other = random_image("other.jpg", random);
  catalogue.put_images({random_image("one.jpg", random), other});
  ImageRecord refused;  // no pose, no camera, no footprint: nothing of the old record may shine through
  refused.name = "one.jpg";
  refused.status = ImageStatus::refused;
  refused.reason = "it is no photograph";
  catalogue.put_images({refused});
  expect_equal(catalogue.images(), {refused, other});
}

TEST_F(CatalogueTest, the_last_of_several_records_of_one_name_wins) {
  Random random(55);
  Catalogue catalogue(path(), kUtm);
  const ImageRecord last = random_image("one.jpg", random);
  catalogue.put_images({random_image("one.jpg", random), random_image("one.jpg", random), last});
  expect_equal(catalogue.images(), {last});
}

TEST_F(CatalogueTest, removes_only_what_is_named) {
  Random random(56);
  Catalogue catalogue(path(), kUtm);
  const std::vector<ImageRecord> images = {random_image("a", random), random_image("b", random),
                                           random_image("c", random)};
  catalogue.put_images(images);
  catalogue.put_tiles({some_tile("l0x0y0"), some_tile("l0x1y0")});
  catalogue.remove_images({"b", "not there"});
  catalogue.remove_tiles({"l0x0y0"});
  expect_equal(catalogue.images(), {images[0], images[2]});
  expect_equal(catalogue.tiles(), {some_tile("l0x1y0")});
}

TEST_F(CatalogueTest, keeps_a_refused_image_whose_numbers_are_not_finite) {
  ImageRecord refused;
  refused.name = "broken.jpg";
  refused.status = ImageStatus::refused;
  refused.reason = "the focal length must be a positive number of pixels";
  refused.model = {4000, 3000, std::numeric_limits<double>::quiet_NaN(), 3000, 2000, 1500, {}};
  refused.pose.center.x = std::numeric_limits<double>::infinity();
  Catalogue catalogue(path(), kUtm);
  catalogue.put_images({refused});
  refused.model = {};
  refused.pose = {};
  expect_equal(catalogue.images(), {refused});
}

TEST_F(CatalogueTest, photographs_of_one_camera_share_its_row_and_unused_rows_go) {
  Random random(57);
  ImageRecord a = random_image("a", random), b = random_image("b", random), c = random_image("c", random);
  b.model = a.model;
  {
    Catalogue catalogue(path(), kUtm);
    catalogue.put_images({a, b, c});
  }
  EXPECT_NE(output_of("ogrinfo -ro -so '" + path().string() + "' cameras").find("Feature Count: 2"), std::string::npos);
  {
    Catalogue catalogue(path(), kUtm);
    catalogue.remove_images({"c"});
    a.model.fx_px += 1;
    catalogue.put_images({a});
    expect_equal(catalogue.images(), {a, b});
    catalogue.remove_images({"b"});
  }
  EXPECT_NE(output_of("ogrinfo -ro -so '" + path().string() + "' cameras").find("Feature Count: 1"), std::string::npos);
}

TEST_F(CatalogueTest, opens_in_other_programs_as_three_layers_with_its_crs) {
  Random random(58);
  {
    Catalogue catalogue(path(), kUtm);
    catalogue.put_images({random_image("a.jpg", random), random_image("b.jpg", random)});
    catalogue.put_images({random_image("a.jpg", random)});
    catalogue.put_tiles({some_tile("l0x0y0")});
  }
  const std::string list = output_of("ogrinfo -ro '" + path().string() + "'");
  EXPECT_NE(list.find("images (Polygon)"), std::string::npos) << list;
  EXPECT_NE(list.find("cameras (None)"), std::string::npos) << list;
  EXPECT_NE(list.find("tiles (Polygon)"), std::string::npos) << list;
  EXPECT_EQ(list.find("Warning"), std::string::npos) << list;
  const std::string images = output_of("ogrinfo -ro -al '" + path().string() + "' images");
  EXPECT_NE(images.find("Feature Count: 2"), std::string::npos) << images;
  EXPECT_NE(images.find("ID[\"EPSG\",32632]"), std::string::npos) << images;
  EXPECT_NE(images.find("view_class (String) = near-vertical"), std::string::npos) << images;
  EXPECT_NE(images.find("POLYGON (("), std::string::npos) << images;
  const std::string tiles = output_of("ogrinfo -ro -al '" + path().string() + "' tiles");
  EXPECT_NE(tiles.find("view_count (Integer) = 2"), std::string::npos) << tiles;
}

TEST_F(CatalogueTest, keeps_the_name_of_a_local_frame) {
  { Catalogue(path(), kLocal); }
  const std::string images = output_of("ogrinfo -ro -so '" + path().string() + "' images");
  EXPECT_NE(images.find("a field behind the house"), std::string::npos) << images;
  EXPECT_EQ(images.find("Warning"), std::string::npos) << images;
}

TEST_F(CatalogueTest, is_empty_when_new_and_leaves_no_other_file_behind) {
  {
    const Catalogue catalogue(path(), kUtm);
    EXPECT_TRUE(catalogue.images().empty());
    EXPECT_TRUE(catalogue.tiles().empty());
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(CatalogueTest, starts_anew_where_a_crash_left_an_unfinished_file) {
  std::ofstream(folder_ / "catalog.unfinished.gpkg") << "half a file";
  EXPECT_TRUE(Catalogue(path(), kUtm).images().empty());
  EXPECT_FALSE(fs::exists(folder_ / "catalog.unfinished.gpkg"));
}

TEST_F(CatalogueTest, of_a_thousand_images_is_read_as_it_was_written) {
  Random random(59);
  std::vector<ImageRecord> images;
  for (int i = 0; i < 1000; ++i) images.push_back(random_image("IMG_" + std::to_string(10'000 + i), random));
  Catalogue catalogue(path(), kUtm);
  catalogue.put_images(images);
  expect_equal(catalogue.images(), images);
}

TEST_F(CatalogueTest, refuses_a_damaged_file_with_a_sentence) {
  std::ofstream(path()) << "this is no GeoPackage at all";
  const auto [message, kind] = error_of([&] { Catalogue(path(), kUtm); });
  EXPECT_EQ(kind, ErrorKind::bad_input);
  EXPECT_NE(message.find(path().string()), std::string::npos) << message;
  EXPECT_NE(message.find("move the file away"), std::string::npos) << message;
}

TEST_F(CatalogueTest, refuses_a_file_whose_inside_is_damaged) {
  Random random(60);
  {
    std::vector<ImageRecord> images;
    for (int i = 0; i < 200; ++i) images.push_back(random_image("IMG_" + std::to_string(1000 + i), random));
    Catalogue(path(), kUtm).put_images(images);
  }
  {
    // The first pages describe the tables and stay; all that follows is overwritten.
    const auto size = static_cast<std::streamoff>(fs::file_size(path()));
    std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(size / 2);
    file << std::string(static_cast<std::size_t>(size - size / 2), '\x5a');
  }
  const auto [message, kind] = error_of([&] { Catalogue(path(), kUtm).images(); });
  EXPECT_EQ(kind, ErrorKind::bad_input);
  EXPECT_NE(message.find(path().string()), std::string::npos) << message;
}

TEST_F(CatalogueTest, refuses_a_geopackage_that_is_none_of_ours) {
  std::ofstream(folder_ / "point.csv") << "WKT,name\n\"POINT (1 2)\",a\n";
  output_of("ogr2ogr -f GPKG '" + path().string() + "' '" + (folder_ / "point.csv").string() + "' -nln images");
  const auto [message, kind] = error_of([&] { Catalogue(path(), kUtm); });
  EXPECT_EQ(kind, ErrorKind::bad_input);
  EXPECT_NE(message.find("has no column status in its layer images"), std::string::npos) << message;
}

TEST_F(CatalogueTest, says_where_it_cannot_write) {
  const fs::path nowhere = folder_ / "missing" / "catalog.gpkg";
  const auto [message, kind] = error_of([&] { Catalogue(nowhere, kUtm); });
  EXPECT_EQ(kind, ErrorKind::failed);
  EXPECT_NE(message.find(nowhere.string()), std::string::npos) << message;
  EXPECT_NE(message.find("writable"), std::string::npos) << message;
}

TEST_F(CatalogueTest, refuses_a_crs_that_is_none_and_leaves_no_file) {
  const auto [message, kind] = error_of([&] { Catalogue(path(), "the moon"); });
  EXPECT_EQ(kind, ErrorKind::bad_input);
  EXPECT_NE(message.find("the moon"), std::string::npos) << message;
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(CatalogueTest, a_change_that_cannot_be_written_leaves_everything_as_it_was) {
  Random random(61);
  std::vector<ImageRecord> few, many;
  for (int i = 0; i < 10; ++i) few.push_back(random_image("few" + std::to_string(i), random));
  for (int i = 0; i < 1000; ++i) many.push_back(random_image("many" + std::to_string(i), random));
  many.push_back(random_image("few3", random));
  {
    Catalogue catalogue(path(), kUtm);
    catalogue.put_images(few);
    const FullDisk full_disk(fs::file_size(path()) + 50'000);
    const auto [message, kind] = error_of([&] { catalogue.put_images(many); });
    EXPECT_EQ(kind, ErrorKind::failed);
    EXPECT_NE(message.find("cannot write the catalogue " + path().string()), std::string::npos) << message;
    expect_equal(catalogue.images(), few);
  }
  Catalogue catalogue(path(), kUtm);
  expect_equal(catalogue.images(), few);
  catalogue.put_images(many);
  EXPECT_EQ(catalogue.images().size(), 1010u);
}

}  // namespace
}  // namespace skysweep::index
