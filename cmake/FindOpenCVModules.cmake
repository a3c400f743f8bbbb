# SPDX-License-Identifier: Apache-2.0
# OpenCV's modules one by one. Debian's OpenCVConfig.cmake comes only with libopencv-dev, which brings viewers, Java and
# VTK along; the modules used here have -dev packages of their own.

find_path(OpenCVModules_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(OpenCVModules_LIBRARIES_FOUND TRUE)
foreach(module core imgcodecs imgproc calib3d)
  find_library(OpenCVModules_${module}_LIBRARY opencv_${module})
  if(NOT OpenCVModules_${module}_LIBRARY)
    set(OpenCVModules_LIBRARIES_FOUND FALSE)
  elseif(NOT TARGET opencv::${module})
    add_library(opencv::${module} UNKNOWN IMPORTED)
    set_target_properties(opencv::${module} PROPERTIES
      IMPORTED_LOCATION ${OpenCVModules_${module}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${OpenCVModules_INCLUDE_DIR})
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVModules REQUIRED_VARS OpenCVModules_INCLUDE_DIR OpenCVModules_LIBRARIES_FOUND)
