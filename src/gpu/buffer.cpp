// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace skysweep::gpu {

Buffer::Buffer(Device& device, std::size_t bytes) : device_(&device), bytes_(std::max<std::size_t>(bytes, 4)) {
  if (bytes_ > static_cast<std::size_t>(device.limits().storage_block_bytes))
    throw DeviceError(Trouble::out_of_memory,
                      device.name() + " cannot bind a buffer of " + std::to_string(bytes_ >> 20) + " MiB.");
  const Current current(device);
  glCreateBuffers(1, &id_);
  glNamedBufferStorage(id_, static_cast<GLsizeiptr>(bytes_), nullptr, GL_DYNAMIC_STORAGE_BIT);
  try {
    device.check("making a buffer of " + std::to_string(bytes_ >> 10) + " KiB");
  } catch (...) {
    glDeleteBuffers(1, &id_);
    throw;
  }
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_), bytes_(other.bytes_), id_(std::exchange(other.id_, 0)) {}

Buffer::~Buffer() {
  if (id_ == 0) return;
  try {
    const Current current(*device_);
    glDeleteBuffers(1, &id_);
  } catch (const DeviceError&) {
    // With the context went everything in it.
  }
}

void Buffer::write(const void* from, std::size_t bytes, std::size_t offset) {
  SKY_CHECK_LE(offset + bytes, bytes_);
  const Current current(*device_);
  glNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), from);
  device_->check("writing a buffer");
}

void Buffer::fill(std::int32_t word) {
  const Current current(*device_);
  glClearNamedBufferData(id_, GL_R32I, GL_RED_INTEGER, GL_INT, &word);
  device_->check("filling a buffer");
}

void Buffer::read(void* to, std::size_t bytes, std::size_t offset) const {
  SKY_CHECK_LE(offset + bytes, bytes_);
  const Current current(*device_);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), to);
  device_->check("reading a buffer");
}

}  // namespace skysweep::gpu
