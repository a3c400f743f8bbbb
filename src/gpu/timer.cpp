// SPDX-License-Identifier: Apache-2.0
#include "gpu/timer.h"

#include <epoxy/gl.h>

#include "core/check.h"

namespace skysweep::gpu {

Timer::Timer(Device& device) : device_(device) {
  const Current current(device);
  glCreateQueries(GL_TIME_ELAPSED, 1, &id_);
  glBeginQuery(GL_TIME_ELAPSED, id_);
  device.check("starting a timer");
}

Timer::~Timer() {
  try {
    const Current current(device_);
    if (running_) glEndQuery(GL_TIME_ELAPSED);
    glDeleteQueries(1, &id_);
  } catch (const DeviceError&) {
    // With the context went everything in it.
  }
}

double Timer::stop_s() {
  SKY_CHECK(running_);
  const Current current(device_);
  glEndQuery(GL_TIME_ELAPSED);
  running_ = false;
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &nanoseconds);
  device_.check("reading a timer");
  return static_cast<double>(nanoseconds) * 1e-9;
}

}  // namespace skysweep::gpu
