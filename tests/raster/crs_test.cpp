// SPDX-License-Identifier: Apache-2.0
#include "raster/crs.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

using testing_support::message_of;

std::string refusal_of(const std::string& text) {
  return message_of<Error>([&] { crs_from_user_input(text); });
}

TEST(Crs, projected_systems_in_metres_are_taken_in_every_spelling) {
  const std::string utm = crs_from_user_input("EPSG:32615");
  EXPECT_EQ(crs_name(utm), "WGS 84 / UTM zone 15N (EPSG:32615)");
  EXPECT_TRUE(same_crs(crs_from_user_input(utm), utm));
  EXPECT_TRUE(same_crs(crs_from_user_input("+proj=utm +zone=15 +datum=WGS84 +units=m"), utm));
  EXPECT_FALSE(same_crs(crs_from_user_input("EPSG:32616"), utm));
}

TEST(Crs, wkt_is_stable_when_it_is_read_again) {
  for (const char* text : {"EPSG:32615", "EPSG:2193", "EPSG:31467", "EPSG:32615+5773"}) {
    const std::string wkt = crs_from_user_input(text);
    EXPECT_EQ(crs_from_user_input(wkt), wkt) << text;
  }
  EXPECT_EQ(crs_from_user_input(local_metric_crs()), local_metric_crs());
}

TEST(Crs, local_frame_is_labelled_and_differs_from_all_others) {
  EXPECT_EQ(crs_name(local_metric_crs()), "local metric frame (no CRS given)");
  EXPECT_TRUE(same_crs(local_metric_crs(), local_metric_crs()));
  EXPECT_FALSE(same_crs(local_metric_crs(), crs_from_user_input("EPSG:32615")));
}

TEST(Crs, degrees_are_refused_with_advice) {
  const std::string message = refusal_of("EPSG:4326");
  EXPECT_NE(message.find("EPSG:4326"), std::string::npos);
  EXPECT_NE(message.find("degrees"), std::string::npos);
  EXPECT_NE(message.find("UTM"), std::string::npos);
}

TEST(Crs, feet_are_refused_in_plan_and_in_height) {
  EXPECT_NE(refusal_of("EPSG:2225").find("foot"), std::string::npos);
  EXPECT_NE(refusal_of("EPSG:32615+6360").find("foot"), std::string::npos);
}

TEST(Crs, what_is_no_plane_or_unknown_is_refused) {
  for (const char* text : {"EPSG:4978", "EPSG:5773", "EPSG:999999", "32615?", "", "/etc/passwd"}) {
    try {
      crs_from_user_input(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
    }
  }
}

TEST(Crs, vertical_reference_is_the_compound_part_or_said_to_be_unknown) {
  EXPECT_EQ(vertical_reference(crs_from_user_input("EPSG:32615+5773")), "EGM96 height");
  EXPECT_EQ(vertical_reference(crs_from_user_input("EPSG:32615")), "unknown: as in the photographs' poses");
  EXPECT_EQ(vertical_reference(local_metric_crs()), "unknown: as in the photographs' poses");
}

// Snyder, Map Projections, formula 8: on the central meridian of a UTM zone the easting is 500 km; the equator is
// northing 0. A metre along the meridian at the equator is 1 / (0.9996 x 6335439) radians.
TEST(Crs, places_on_earth_are_those_of_the_projection) {
  const auto at = wgs84_positions(crs_from_user_input("EPSG:32632"), {{500000, 0}, {500000, 1000}});
  ASSERT_TRUE(at);
  EXPECT_NEAR((*at)[0].latitude_deg, 0, 1e-9);
  EXPECT_NEAR((*at)[0].longitude_deg, 9, 1e-9);
  EXPECT_NEAR((*at)[1].latitude_deg, 1000 / (0.9996 * 6335439.3) * 180 / 3.141592653589793, 1e-8);
}

TEST(Crs, a_local_frame_is_nowhere_on_earth) { EXPECT_FALSE(wgs84_positions(local_metric_crs(), {{1, 2}})); }

}  // namespace
}  // namespace skysweep::raster
