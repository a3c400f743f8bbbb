// SPDX-License-Identifier: Apache-2.0
// A machine on which EGL finds no driver. A program of its own: drivers are looked up once in a process.
#include <gtest/gtest.h>

#include <cstdlib>

#include "gpu/device.h"

namespace skysweep::gpu {
namespace {

TEST(NoGpu, is_an_error_that_says_so) {
  setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
  try {
    Device::open();
    FAIL() << "opened a device without a driver";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.trouble(), Trouble::unavailable);
    EXPECT_NE(std::string(error.what()).find("OpenGL 4.5"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace skysweep::gpu
