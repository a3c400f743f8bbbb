// SPDX-License-Identifier: Apache-2.0
// The device that tests run on; they skip, with the reason, on a machine that has none.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "gpu/device.h"

namespace skysweep::test {

// Null, and the reason in `why`, where no context can be made.
inline std::unique_ptr<gpu::Device> open_gpu(std::string& why) {
  try {
    return gpu::Device::open();
  } catch (const gpu::DeviceError& error) {
    why = error.what();
    return nullptr;
  }
}

}  // namespace skysweep::test

// Opens `device` or skips the test.
#define SKY_OPEN_GPU_OR_SKIP(device)                                                          \
  std::string why_no_gpu;                                                                     \
  const std::unique_ptr<skysweep::gpu::Device> device = skysweep::test::open_gpu(why_no_gpu); \
  if (!device) GTEST_SKIP() << why_no_gpu
