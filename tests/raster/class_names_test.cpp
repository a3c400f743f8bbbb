// SPDX-License-Identifier: Apache-2.0
#include "raster/class_names.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "raster/crs.h"
#include "raster/geotiff.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

using namespace testing_support;
using Names = std::vector<std::string>;

class ClassNames : public testing::Test {
 protected:
  // A raster of one cell; `beside` becomes the .aux.xml file with what GDAL users say of it.
  Names names_of(const std::string& content, const std::string& beside = "") {
    write_geotiff(folder / "classes.tif",
                  Raster<std::uint8_t>{
                      Array2d<std::uint8_t>(1, 1, 1), {local_metric_crs(), {0, 0}, 1}, {content, "", "", "", ""}});
    if (!beside.empty()) put_bytes(folder / "classes.tif.aux.xml", "<PAMDataset>" + beside + "</PAMDataset>");
    return read_class_names(folder / "classes.tif");
  }
  TempFolder folder;
};

TEST_F(ClassNames, simulated_truth_names_its_codes_in_its_label) {
  EXPECT_EQ(names_of("surface class: 1 ground, 2 roof, 3 facade edge, 4 tree, 5 water, 6 thin"),
            (Names{"", "ground", "roof", "facade edge", "tree", "water", "thin"}));
  EXPECT_EQ(names_of("class: 7 hedge, 2 lane"), (Names{"", "", "lane", "", "", "", "", "hedge"}));
}

TEST_F(ClassNames, labels_that_list_no_codes_name_nothing) {
  for (const char* content : {"", "number of photographs", "class: ground, roof", "class: 300 ground", "class: 2",
                              "class: -1 ground", "ratio 1:2"})
    EXPECT_EQ(names_of(content), Names{}) << content;
}

TEST_F(ClassNames, category_names_go_before_the_metadata_item_and_that_before_the_label) {
  const std::string item = "<Metadata><MDI key=\"CLASS_NAMES\">none, ground ,roof</MDI></Metadata>";
  const std::string categories =
      "<PAMRasterBand band=\"1\"><CategoryNames><Category>nothing</Category><Category>lawn</Category></CategoryNames>"
      "</PAMRasterBand>";
  EXPECT_EQ(names_of("class: 1 a", item), (Names{"none", "ground", "roof"}));
  EXPECT_EQ(names_of("class: 1 a", item + categories), (Names{"nothing", "lawn"}));
}

TEST_F(ClassNames, a_file_that_is_no_raster_is_named) {
  put_bytes(folder / "no.tif", "no");
  EXPECT_NE(message_of<Error>([&] { read_class_names(folder / "no.tif"); }).find("no.tif"), std::string::npos);
}

}  // namespace
}  // namespace skysweep::raster
