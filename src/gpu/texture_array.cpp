// SPDX-License-Identifier: Apache-2.0
#include "gpu/texture_array.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "core/check.h"

namespace skysweep::gpu {

TextureArray::TextureArray(Device& device, int width, int height, int layers, int levels, Filter filter)
    : device_(&device), width_(width), height_(height), layers_(layers), levels_(levels) {
  SKY_CHECK(width > 0 && height > 0 && layers > 0 && levels > 0);
  if (std::max(width, height) > device.limits().texture_size || layers > device.limits().texture_layers)
    throw DeviceError(Trouble::out_of_memory, device.name() + " holds no textures of " + std::to_string(width) + " x " +
                                                  std::to_string(height) + " x " + std::to_string(layers) + ".");
  for (int level = 0; level < levels; ++level)
    bytes_ += sizeof(std::uint16_t) * std::max(1, width >> level) * std::max(1, height >> level) * layers;
  const Current current(device);
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id_);
  const bool linear = filter == Filter::linear;
  glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
  glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureStorage3D(id_, levels, GL_R16, width, height, layers);
  try {
    device.check("making a texture of " + std::to_string(bytes_ >> 20) + " MiB");
  } catch (...) {
    glDeleteTextures(1, &id_);
    throw;
  }
}

TextureArray::TextureArray(TextureArray&& other) noexcept
    : device_(other.device_),
      width_(other.width_),
      height_(other.height_),
      layers_(other.layers_),
      levels_(other.levels_),
      bytes_(other.bytes_),
      id_(std::exchange(other.id_, 0)) {}

TextureArray& TextureArray::operator=(TextureArray&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  std::swap(layers_, other.layers_);
  std::swap(levels_, other.levels_);
  std::swap(bytes_, other.bytes_);
  std::swap(id_, other.id_);
  return *this;
}

TextureArray::~TextureArray() {
  if (id_ == 0) return;
  try {
    const Current current(*device_);
    glDeleteTextures(1, &id_);
  } catch (const DeviceError&) {
    // With the context went everything in it.
  }
}

void TextureArray::write(int layer, int level, int x, int y, int width, int height, const std::uint16_t* from,
                         int stride) {
  SKY_CHECK(layer >= 0 && layer < layers_ && level >= 0 && level < levels_);
  SKY_CHECK(x >= 0 && y >= 0 && x + width <= std::max(1, width_ >> level) &&
            y + height <= std::max(1, height_ >> level));
  const Current current(*device_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, stride);
  glTextureSubImage3D(id_, level, x, y, layer, width, height, 1, GL_RED, GL_UNSIGNED_SHORT, from);
  device_->check("writing a texture");
}

void TextureArray::copy_layers(const TextureArray& from, int count) {
  SKY_CHECK(from.width_ == width_ && from.height_ == height_ && from.levels_ == levels_);
  SKY_CHECK_LE(count, std::min(from.layers_, layers_));
  const Current current(*device_);
  for (int level = 0; level < levels_; ++level)
    glCopyImageSubData(from.id_, GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, id_, GL_TEXTURE_2D_ARRAY, level, 0, 0, 0,
                       std::max(1, width_ >> level), std::max(1, height_ >> level), count);
  device_->check("copying textures");
}

}  // namespace skysweep::gpu
