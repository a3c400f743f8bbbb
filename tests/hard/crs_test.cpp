// SPDX-License-Identifier: Apache-2.0
// Hard cases of coordinate systems: units other than metres in every disguise. (A flight across a UTM zone border:
// flights_test.cpp.)
#include "raster/crs.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace skysweep::hard {
namespace {

// The sentence with which the system is refused; empty if it is taken.
std::string refusal(const std::string& crs) {
  try {
    raster::crs_from_user_input(crs);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return {};
}

struct Feet {
  const char* name;
  const char* crs;
};
std::ostream& operator<<(std::ostream& out, const Feet& feet) { return out << feet.name; }
class HardCrs : public testing::TestWithParam<Feet> {};

// Hard: a foot looks like any other number; taken for a metre, heights are off by 3.28 and nothing else shows it.
// Bound: refused with the unit named, in plan and in height, by code, PROJ string and WKT of either version.
TEST_P(HardCrs, feet_are_refused_by_name) {
  const std::string sentence = refusal(GetParam().crs);
  EXPECT_NE(sentence.find("units of"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("metres"), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    Units, HardCrs,
    testing::Values(Feet{"us_survey_feet", "EPSG:2225"}, Feet{"international_feet", "EPSG:2992"},
                    Feet{"heights_in_us_feet", "EPSG:32615+6360"}, Feet{"heights_in_feet", "EPSG:32615+8228"},
                    Feet{"proj_string", "+proj=utm +zone=32 +datum=WGS84 +units=us-ft"},
                    Feet{"proj_string_scaled", "+proj=utm +zone=32 +datum=WGS84 +to_meter=0.3048"},
                    Feet{"proj_string_heights", "+proj=utm +zone=32 +datum=WGS84 +units=m +vunits=us-ft"},
                    Feet{"proj_string_kilometres", "+proj=utm +zone=32 +datum=WGS84 +units=km"},
                    Feet{"local_in_feet", "LOCAL_CS[\"site grid\",UNIT[\"foot\",0.3048]]"},
                    Feet{"ellipsoidal_heights_in_feet",
                         "PROJCRS[\"site\",BASEGEOGCRS[\"WGS 84\",DATUM[\"World Geodetic System 1984\","
                         "ELLIPSOID[\"WGS 84\",6378137,298.257223563]]],CONVERSION[\"UTM zone 32N\","
                         "METHOD[\"Transverse Mercator\"],PARAMETER[\"Latitude of natural origin\",0],"
                         "PARAMETER[\"Longitude of natural origin\",9],"
                         "PARAMETER[\"Scale factor at natural origin\",0.9996],PARAMETER[\"False easting\",500000],"
                         "PARAMETER[\"False northing\",0]],CS[Cartesian,3],AXIS[\"(E)\",east,LENGTHUNIT[\"metre\",1]],"
                         "AXIS[\"(N)\",north,LENGTHUNIT[\"metre\",1]],AXIS[\"h\",up,LENGTHUNIT[\"foot\",0.3048]]]"}),
    [](const auto& i) { return std::string(i.param.name); });

// What must not be refused along with it.
TEST(HardCrsMetres, are_taken_with_heights_in_metres) {
  for (const char* crs : {"EPSG:32615", "EPSG:32615+5773", "+proj=utm +zone=32 +datum=WGS84 +units=m"})
    EXPECT_EQ(refusal(crs), "") << crs;
}

}  // namespace
}  // namespace skysweep::hard
