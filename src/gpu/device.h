// SPDX-License-Identifier: Apache-2.0
// A graphics processor for computing: an OpenGL 4.5 core context without a window, made through EGL. A real GPU is
// taken where there is one (EGL's device platform), else Mesa's software rasteriser. Compute shaders only: nothing
// here draws.
//
// A context belongs to one thread at a time. Every function of this module makes it current itself (Current), under a
// lock, so objects may be used from any thread; callers with several steps that belong together hold a Current over
// them. What was made on a device must not outlive it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "core/error.h"

namespace skysweep::gpu {

// What the work may be done without: the caller can do it elsewhere.
enum class Trouble {
  unavailable,    // no context can be made on this machine
  lost,           // the driver gave the context up (reset, unplugged, hung): the device is of no more use
  out_of_memory,  // this work does not fit; smaller work may
  refused,        // anything else that the driver did not take
};

class DeviceError : public Error {
 public:
  DeviceError(Trouble trouble, const std::string& message) : Error(ErrorKind::failed, message), trouble_(trouble) {}
  Trouble trouble() const { return trouble_; }

 private:
  Trouble trouble_;
};

// What shaders may count on; see the constants of the same names in OpenGL.
struct DeviceLimits {
  std::int64_t storage_block_bytes = 0;
  int shared_memory_bytes = 0;
  int texture_size = 0;
  int texture_layers = 0;
};

class Device {
 public:
  // The first real GPU that gives a context, else the software rasteriser. Throws DeviceError(unavailable) with every
  // reason on a machine that has neither; never ends the program.
  static std::unique_ptr<Device> open();
  // Whether EGL lists a GPU that is not a rasteriser on the CPU; quick, and opens nothing.
  static bool lists_real_gpu();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const std::string& name() const;  // as the driver calls it, with its version
  bool is_software() const;         // a rasteriser on the CPU
  const DeviceLimits& limits() const;

  // Waits until everything asked for so far is done. Throws DeviceError(lost) if the context went meanwhile.
  void finish();

  // Throws DeviceError if OpenGL has an error to report or the context is lost; `doing` says in the message what was
  // being done.
  void check(const std::string& doing);

  // From now on every call throws DeviceError(lost), as after a reset of the driver: for callers that no longer trust
  // the device, and for tests of what they then do.
  void give_up();

 private:
  friend class Current;
  struct Context;
  explicit Device(std::unique_ptr<Context> context);
  std::unique_ptr<Context> context_;
};

// The device's context is current on this thread while this lives; other threads wait. May be nested.
class Current {
 public:
  explicit Current(Device& device);
  ~Current();
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  Device& device_;
  std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace skysweep::gpu
