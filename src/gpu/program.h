// SPDX-License-Identifier: Apache-2.0
// A compute shader, compiled.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/texture_array.h"

namespace skysweep::gpu {

class Program {
 public:
  // `source`: GLSL without its #version line, which is 4.50; `definitions` become macros before it, so that loops have
  // constant lengths. Throws DeviceError(refused) with the compiler's log, which names `name`.
  Program(Device& device, const std::string& name, const std::vector<std::pair<std::string, std::string>>& definitions,
          const std::string& source);
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&&) = delete;

  // Uniforms keep their values from run to run. A name that no code of
  // the shader depends on is passed over: compilers differ in what they leave out.
  void set(const char* uniform, int value);
  void set(const char* uniform, float value);

  // Work groups along x; beyond 65535 they go on along y, so a shader numbers them
  // gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and passes over those it has not asked for. Returns at
  // once; later runs and reads see everything written. `buffers` are the shader's storage blocks 0, 1, ...; `texture`
  // is its sampler, `constants` its uniform block, both of binding 0.
  void run(std::int64_t groups, const std::vector<const Buffer*>& buffers, const TextureArray* texture = nullptr,
           const Buffer* constants = nullptr);

 private:
  Device* device_;
  std::string name_;
  unsigned id_ = 0;
};

}  // namespace skysweep::gpu
