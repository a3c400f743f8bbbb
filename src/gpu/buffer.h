// SPDX-License-Identifier: Apache-2.0
// Memory on the device that compute programs read and write (shader storage).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "gpu/device.h"

namespace skysweep::gpu {

class Buffer {
 public:
  // Of undefined content. Throws DeviceError(out_of_memory) when the device cannot hold it, or no program could see
  // all of it. A size of 0 is made one word, so that it can be bound.
  Buffer(Device& device, std::size_t bytes);
  // With these values.
  template <typename T>
  Buffer(Device& device, const std::vector<T>& values) : Buffer(device, values.size() * sizeof(T)) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!values.empty()) write(values.data(), values.size() * sizeof(T));
  }
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&&) = delete;

  std::size_t bytes() const { return bytes_; }
  void write(const void* from, std::size_t bytes, std::size_t offset = 0);
  void fill(std::int32_t word);
  // Waits for the programs that write it.
  void read(void* to, std::size_t bytes, std::size_t offset = 0) const;

 private:
  friend class Program;
  Device* device_;
  std::size_t bytes_;
  unsigned id_ = 0;
};

}  // namespace skysweep::gpu
