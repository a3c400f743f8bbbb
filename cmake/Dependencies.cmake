# SPDX-License-Identifier: Apache-2.0
# Third-party libraries, all from Debian 12 packages (config/packages.txt); the README says what each is for.

find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(GDAL CONFIG REQUIRED)
find_package(HWY CONFIG REQUIRED)
find_package(embree REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenCVModules REQUIRED)
if(SKYSWEEP_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(SKYSWEEP_BENCH)
  find_package(benchmark REQUIRED)
endif()
