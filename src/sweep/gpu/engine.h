// SPDX-License-Identifier: Apache-2.0
// What the gpu backend keeps between calls: the device, its compiled programs, the photographs on it and the large
// buffers. One for the process, opened when first needed, replaced when its context is lost.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "gpu/program.h"
#include "sweep/gpu/photograph_store.h"

namespace skysweep::sweep::on_gpu {

// Large buffers that are used again by each tile.
enum class Scratch { costs, sums, matches };

class Engine {
 public:
  Engine();  // throws gpu::DeviceError(unavailable)

  skysweep::gpu::Device& device() { return *device_; }
  PhotographStore& photographs() { return photographs_; }

  // Compiled on first use. `files` of shaders/ in order; the constants that all of them share come by themselves.
  skysweep::gpu::Program& program(const std::vector<std::string>& files,
                                  const std::vector<std::pair<std::string, std::string>>& definitions);
  // At least so large, of undefined content; the same until the next call for the same purpose.
  skysweep::gpu::Buffer& scratch(Scratch purpose, std::size_t bytes);

 private:
  std::unique_ptr<skysweep::gpu::Device> device_;
  PhotographStore photographs_;
  std::map<std::string, skysweep::gpu::Program> programs_;
  std::map<Scratch, skysweep::gpu::Buffer> scratch_;
};

// The engine of the process. Throws gpu::DeviceError(unavailable) with the reason if there is no device, or if the
// device was lost too often to be trusted.
std::shared_ptr<Engine> engine();

// What failed on `engine` was said to be lost: the next call of engine() opens a device anew.
void abandon(const std::shared_ptr<Engine>& engine);

// Where the user is told that a tile had to be computed without the GPU (sweep/backend.h).
void set_gpu_listener(std::function<void(const std::string&)> listener);
void tell_gpu_listener(const std::string& sentence);

}  // namespace skysweep::sweep::on_gpu
