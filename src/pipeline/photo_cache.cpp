// SPDX-License-Identifier: Apache-2.0
#include "pipeline/photo_cache.h"

#include "raster/photo.h"

namespace skysweep::pipeline {

PhotoCache::PhotoCache(std::filesystem::path folder, std::size_t capacity_bytes, sweep::Normalization normalization)
    : folder_(std::move(folder)), capacity_bytes_(capacity_bytes), normalization_(normalization) {}

std::shared_ptr<const sweep::ImagePyramid> PhotoCache::get(const std::string& name) {
  std::unique_lock lock(mutex_);
  for (auto found = entries_.find(name); found != entries_.end(); found = entries_.find(name)) {
    if (found->second.image) {
      by_age_.splice(by_age_.begin(), by_age_, found->second.age);
      return found->second.image;
    }
    decoded_one_.wait(lock);
  }
  by_age_.push_front(name);
  entries_[name] = {nullptr, by_age_.begin()};
  lock.unlock();

  std::shared_ptr<const sweep::ImagePyramid> image;
  try {
    image = std::make_shared<sweep::ImagePyramid>(raster::read_photo(folder_ / name), normalization_);
  } catch (...) {
    lock.lock();
    by_age_.erase(entries_[name].age);
    entries_.erase(name);
    decoded_one_.notify_all();
    throw;
  }

  lock.lock();
  make_room(image->bytes());
  bytes_ += image->bytes();
  ++decoded_;
  entries_[name].image = image;
  decoded_one_.notify_all();
  return image;
}

void PhotoCache::make_room(std::size_t bytes) {
  for (auto oldest = by_age_.end(); bytes_ + bytes > capacity_bytes_ && oldest != by_age_.begin();) {
    --oldest;
    const auto entry = entries_.find(*oldest);
    const bool in_use = !entry->second.image || entry->second.image.use_count() > 1;
    if (in_use) continue;
    bytes_ -= entry->second.image->bytes();
    entries_.erase(entry);
    oldest = by_age_.erase(oldest);
  }
}

int PhotoCache::decoded() const {
  const std::lock_guard lock(mutex_);
  return decoded_;
}

}  // namespace skysweep::pipeline
