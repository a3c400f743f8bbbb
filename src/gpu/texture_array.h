// SPDX-License-Identifier: Apache-2.0
// Pictures of one 16-bit channel and one size, layer after layer, on the device. Programs see values 0 to 65535 as 0 to
// 1 and read them by texelFetch, textureGather or through the filter.
#pragma once

#include <cstdint>

#include "gpu/device.h"

namespace skysweep::gpu {

enum class Filter {
  nearest,
  linear,  // between pixels and between levels; hardware rounds the weights to 8 bits
};

class TextureArray {
 public:
  // Of undefined content. Throws DeviceError(out_of_memory) when the device cannot hold it, or not in this size.
  // `levels`: mipmap levels, each half as large as the one before, rounded down.
  TextureArray(Device& device, int width, int height, int layers, int levels = 1, Filter filter = Filter::nearest);
  ~TextureArray();
  TextureArray(TextureArray&& other) noexcept;
  TextureArray& operator=(TextureArray&& other) noexcept;

  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }
  std::size_t bytes() const { return bytes_; }

  // Part of one layer's level from an array whose rows are `stride` elements apart.
  void write(int layer, int level, int x, int y, int width, int height, const std::uint16_t* from, int stride);
  // The first layers from another array of the same size and levels, within the device.
  void copy_layers(const TextureArray& from, int count);

 private:
  friend class Program;
  Device* device_;
  int width_, height_, layers_, levels_;
  std::size_t bytes_ = 0;
  unsigned id_ = 0;
};

}  // namespace skysweep::gpu
