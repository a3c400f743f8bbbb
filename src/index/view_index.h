// SPDX-License-Identifier: Apache-2.0
// Which photographs can see a place: an R*-tree over the boxes of their view pyramids (Feldmann 2013).
#pragma once

#include <memory>
#include <vector>

#include "core/box.h"

namespace skysweep::index {

// Incremental: boxes may be added and removed at any time. Not safe for writing while another thread reads.
class ViewIndex {
 public:
  ViewIndex();
  ~ViewIndex();
  ViewIndex(ViewIndex&&) noexcept;
  ViewIndex& operator=(ViewIndex&&) noexcept;

  // `id` is the caller's. `near_vertical`: whether the photograph counts for the mapped area.
  void insert(int id, const Box3d& box, bool near_vertical);
  void remove(int id);
  int size() const;

  // Ids whose box meets the query box, in ascending order.
  std::vector<int> query(const Box3d& box) const;

  // Box around all view pyramids, and around the ground boxes of the (near-)vertical ones: the mapped area.
  Box3d extent() const;
  Box2d mapped_area() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skysweep::index
