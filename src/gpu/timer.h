// SPDX-License-Identifier: Apache-2.0
// How long the device itself was busy, without what lies between it and the caller.
#pragma once

#include "gpu/device.h"

namespace skysweep::gpu {

// Counts from its making. One timer at a time on a device.
class Timer {
 public:
  explicit Timer(Device& device);
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  // Stops, waits for what was asked for since the making, and gives its seconds on the device.
  double stop_s();

 private:
  Device& device_;
  bool running_ = true;
  unsigned id_ = 0;
};

}  // namespace skysweep::gpu
