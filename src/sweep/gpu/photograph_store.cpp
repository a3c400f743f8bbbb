// SPDX-License-Identifier: Apache-2.0
#include "sweep/gpu/photograph_store.h"

#include <algorithm>
#include <set>

namespace skysweep::sweep::on_gpu {

namespace {
constexpr int kBorder = 1;  // of LuminanceLevel, on every side
}

LayerLayout layer_layout(const ImagePyramid& image) {
  LayerLayout layout;
  int x = 0;
  for (int level = 0; level < image.levels(); ++level) {
    const int width = image.luminance(level).width + 2 * kBorder, height = image.luminance(level).height + 2 * kBorder;
    const int y = level == 0 ? 0 : image.luminance(0).height + 2 * kBorder;  // the coarser ones in a row below
    layout.levels.push_back({x + kBorder, y + kBorder});
    layout.width = std::max(layout.width, x + width);
    layout.height = std::max(layout.height, y + height);
    x = level == 0 ? 0 : x + width;
  }
  return layout;
}

std::vector<int> PhotographStore::layers_of(const std::vector<View>& views) {
  int width = texture_ ? texture_->width() : 1, height = texture_ ? texture_->height() : 1;
  for (const View& view : views) {
    const LayerLayout layout = layer_layout(*view.image);
    width = std::max(width, layout.width);
    height = std::max(height, layout.height);
  }
  make_room(width, height, views);
  ++clock_;
  for (const View& view : views)  // first, so that none of them makes room for another
    if (const std::optional<int> layer = find(view.image->id())) layers_[*layer].used = clock_;
  std::vector<int> layers;
  for (const View& view : views) {
    std::optional<int> layer = find(view.image->id());
    if (!layer) {
      layer = free_layer();
      layers_[*layer].image = 0;  // should the upload fail
      upload(*view.image, *layer);
      layers_[*layer] = {view.image->id(), clock_};
    }
    layers.push_back(*layer);
  }
  return layers;
}

void PhotographStore::make_room(int width, int height, const std::vector<View>& views) {
  std::set<std::uint64_t> missing, wanted;
  for (const View& view : views) {
    wanted.insert(view.image->id());
    if (!find(view.image->id())) missing.insert(view.image->id());
  }
  const bool fits = texture_ && texture_->width() >= width && texture_->height() >= height;
  if (!fits) {
    texture_.reset();
    layers_.clear();
    missing = wanted;
  }
  const auto resident = std::count_if(layers_.begin(), layers_.end(), [](const Layer& l) { return l.image != 0; });
  const int needed = static_cast<int>(resident) + static_cast<int>(missing.size());
  const int has = static_cast<int>(layers_.size());
  if (texture_ && needed <= has) return;
  const std::size_t layer_bytes = sizeof(std::uint16_t) * width * height;
  const int most = static_cast<int>(std::min<std::size_t>(std::max(limit_bytes_ / layer_bytes, wanted.size()),
                                                          static_cast<std::size_t>(device_.limits().texture_layers)));
  const int count = std::max(1, std::min(most, std::max(needed, 2 * has)));
  if (texture_ && count <= has) return;
  skysweep::gpu::TextureArray larger(device_, width, height, count);
  if (texture_) larger.copy_layers(*texture_, has);
  texture_ = std::move(larger);
  layers_.resize(count);
}

std::optional<int> PhotographStore::find(std::uint64_t image) const {
  for (std::size_t i = 0; i < layers_.size(); ++i)
    if (layers_[i].image == image) return static_cast<int>(i);
  return std::nullopt;
}

int PhotographStore::free_layer() const {
  const auto oldest = std::min_element(layers_.begin(), layers_.end(), [](const Layer& a, const Layer& b) {
    return (a.image == 0 ? 0 : a.used) < (b.image == 0 ? 0 : b.used);
  });
  return static_cast<int>(oldest - layers_.begin());
}

void PhotographStore::upload(const ImagePyramid& image, int layer) {
  const LayerLayout layout = layer_layout(image);
  for (int level = 0; level < image.levels(); ++level) {
    const Array2d<std::uint16_t> pixels = image.luminance(level).pixels_with_border();
    texture_->write(layer, 0, layout.levels[level].x - kBorder, layout.levels[level].y - kBorder, pixels.width(),
                    pixels.height(), pixels.data(), pixels.width());
  }
  ++uploads_;
}

}  // namespace skysweep::sweep::on_gpu
