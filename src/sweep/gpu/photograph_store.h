// SPDX-License-Identifier: Apache-2.0
// The photographs that are on the device: each is uploaded once, with all its mipmap levels side by side in one layer
// of a texture, and stays until others need the room.
//
// Levels are not the texture's own because the sweep samples exactly: it gathers four pixels and weighs them in single
// precision, and textureGather reads one level only. The filter's weights have 8 bits on real GPUs
// (docs/decisions/0010).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/texture_array.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep::on_gpu {

// Pixel of a layer at which pixel (0, 0) of a level lies; the border of LuminanceLevel lies around it.
struct PlacedLevel {
  int x = 0, y = 0;
};
struct LayerLayout {
  std::vector<PlacedLevel> levels;
  int width = 0, height = 0;
};
LayerLayout layer_layout(const ImagePyramid& image);

class PhotographStore {
 public:
  // `limit_bytes`: most that the texture takes, or as many layers as one problem has views, if that is more.
  PhotographStore(skysweep::gpu::Device& device, std::size_t limit_bytes)
      : device_(device), limit_bytes_(limit_bytes) {}

  // Layers of the views' photographs, all there until the next call. Throws gpu::DeviceError if they do not fit.
  std::vector<int> layers_of(const std::vector<View>& views);

  const skysweep::gpu::TextureArray& texture() const { return *texture_; }
  std::size_t bytes() const { return texture_ ? texture_->bytes() : 0; }
  int uploads() const { return uploads_; }  // so far

 private:
  struct Layer {
    std::uint64_t image = 0;  // ImagePyramid::id(); 0: free
    std::uint64_t used = 0;   // when last
  };
  void make_room(int width, int height, const std::vector<View>& views);
  std::optional<int> find(std::uint64_t image) const;
  int free_layer() const;
  void upload(const ImagePyramid& image, int layer);

  skysweep::gpu::Device& device_;
  std::size_t limit_bytes_;
  std::optional<skysweep::gpu::TextureArray> texture_;
  std::vector<Layer> layers_;
  std::uint64_t clock_ = 0;
  int uploads_ = 0;
};

}  // namespace skysweep::sweep::on_gpu
