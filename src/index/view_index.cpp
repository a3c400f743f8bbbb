// SPDX-License-Identifier: Apache-2.0
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost.Geometry 1.74 includes one of Boost's own and says so at every compile
#include "index/view_index.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <unordered_map>
#include <utility>

#include "core/check.h"

namespace skysweep::index {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Point>;
using Leaf = std::pair<TreeBox, int>;
using Tree = bg::index::rtree<Leaf, bg::index::rstar<16>>;

TreeBox to_tree(const Box3d& box) {
  return {Point(box.min.x, box.min.y, box.min.z), Point(box.max.x, box.max.y, box.max.z)};
}

Box3d bounds_of(const Tree& tree) {
  if (tree.empty()) return {};
  const TreeBox box = tree.bounds();
  const Point &low = box.min_corner(), &high = box.max_corner();
  return {{low.get<0>(), low.get<1>(), low.get<2>()}, {high.get<0>(), high.get<1>(), high.get<2>()}};
}

}  // namespace

struct ViewIndex::Impl {
  struct Entry {
    TreeBox box;
    bool near_vertical;
  };
  std::unordered_map<int, Entry> entries;  // the tree removes by value, so the boxes are kept by id
  Tree all;
  Tree near_vertical;  // a second tree, so that the mapped area also shrinks without a walk over all entries
};

ViewIndex::ViewIndex() : impl_(std::make_unique<Impl>()) {}
ViewIndex::~ViewIndex() = default;
ViewIndex::ViewIndex(ViewIndex&&) noexcept = default;
ViewIndex& ViewIndex::operator=(ViewIndex&&) noexcept = default;

void ViewIndex::insert(int id, const Box3d& box, bool near_vertical) {
  SKY_CHECK(!box.empty());
  const TreeBox tree_box = to_tree(box);
  const bool is_new = impl_->entries.insert({id, {tree_box, near_vertical}}).second;
  SKY_CHECK(is_new);
  impl_->all.insert({tree_box, id});
  if (near_vertical) impl_->near_vertical.insert({tree_box, id});
}

void ViewIndex::remove(int id) {
  const auto entry = impl_->entries.find(id);
  SKY_CHECK(entry != impl_->entries.end());
  impl_->all.remove({entry->second.box, id});
  if (entry->second.near_vertical) impl_->near_vertical.remove({entry->second.box, id});
  impl_->entries.erase(entry);
}

int ViewIndex::size() const { return static_cast<int>(impl_->entries.size()); }

std::vector<int> ViewIndex::query(const Box3d& box) const {
  if (box.empty()) return {};
  std::vector<int> ids;
  const auto add_id = [&ids](const Leaf& leaf) { ids.push_back(leaf.second); };
  impl_->all.query(bg::index::intersects(to_tree(box)), boost::make_function_output_iterator(add_id));
  std::sort(ids.begin(), ids.end());
  return ids;
}

Box3d ViewIndex::extent() const { return bounds_of(impl_->all); }

Box2d ViewIndex::mapped_area() const { return bounds_of(impl_->near_vertical).ground(); }

}  // namespace skysweep::index
