# SPDX-License-Identifier: Apache-2.0
# How every module, test and bench of the project is built.

add_library(sky_flags INTERFACE)
# No contraction: the same source gives the same bits whether or not a function is compiled for a machine with FMA.
target_compile_options(sky_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wpedantic -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(sky_flags INTERFACE -Wno-restrict)  # GCC 12 sees overlaps in std::string that are not there (PR 105651)
endif()
target_include_directories(sky_flags INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(SKYSWEEP_SANITIZE)
  target_compile_options(sky_flags INTERFACE -fsanitize=${SKYSWEEP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sky_flags INTERFACE -fsanitize=${SKYSWEEP_SANITIZE})
endif()

# sky_module(name SOURCES a.cpp ... USES module ... [PRIVATE_LIBRARIES target ...])
# A static library sky_<name> from src/<name>/. Third-party libraries stay private: public headers name none.
function(sky_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(sky_${name} STATIC ${ARG_SOURCES})
  list(TRANSFORM ARG_USES PREPEND sky_)
  target_link_libraries(sky_${name} PUBLIC sky_flags ${ARG_USES} PRIVATE ${ARG_PRIVATE_LIBRARIES})
endfunction()

# sky_test(name SOURCES a_test.cpp ... USES module ... [LIBRARIES target ...] [ENVIRONMENT X=y ...] [TIMEOUT s] [LABEL slow])
# A GoogleTest program; each of its tests becomes a CTest of its own. What is labelled slow is left out of sanitizer runs.
function(sky_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT;LABEL" "SOURCES;USES;LIBRARIES;ENVIRONMENT" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  list(TRANSFORM ARG_USES PREPEND sky_)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${ARG_USES} ${ARG_LIBRARIES} GTest::gtest_main)
  set(properties TIMEOUT 600)
  if(ARG_TIMEOUT)
    set(properties TIMEOUT ${ARG_TIMEOUT})
  endif()
  if(ARG_LABEL)
    list(APPEND properties LABELS ${ARG_LABEL})
  endif()
  if(ARG_ENVIRONMENT)
    list(APPEND properties ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
endfunction()
