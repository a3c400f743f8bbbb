// SPDX-License-Identifier: Apache-2.0
// Decoded photographs, kept while there is room for them: the least recently used one goes first. Safe for several
// threads; a photograph that two threads ask for at once is decoded once.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "sweep/image_pyramid.h"

namespace skysweep::pipeline {

class PhotoCache {
 public:
  // `capacity_bytes` bounds what is kept for later; photographs in use count, too, but are never dropped.
  // Photographs are prepared for sweeping with this normalisation (SweepOptions).
  PhotoCache(std::filesystem::path folder, std::size_t capacity_bytes, sweep::Normalization normalization);

  // Throws what reading the photograph throws; a later call tries again.
  std::shared_ptr<const sweep::ImagePyramid> get(const std::string& name);

  int decoded() const;  // how often a photograph was decoded so far

 private:
  struct Entry {
    std::shared_ptr<const sweep::ImagePyramid> image;  // null while it is being decoded
    std::list<std::string>::iterator age;
  };
  void make_room(std::size_t bytes);

  std::filesystem::path folder_;
  std::size_t capacity_bytes_;
  sweep::Normalization normalization_;
  mutable std::mutex mutex_;
  std::condition_variable decoded_one_;
  std::map<std::string, Entry> entries_;
  std::list<std::string> by_age_;  // most recently used first
  std::size_t bytes_ = 0;
  int decoded_ = 0;
};

}  // namespace skysweep::pipeline
