// SPDX-License-Identifier: Apache-2.0
#include "scene/world/tree_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/random.h"
#include "scene/world/surface_class.h"
#include "scene/world/tracer.h"

namespace skysweep::scene {
namespace {

constexpr Box2d kExtent{{-100, -100}, {200, 200}};

TEST(TreeShapes, leaves_lie_within_the_outline_of_their_crown) {
  for (int prototype = 0; prototype < kTreePrototypes; ++prototype) {
    const auto shape = static_cast<CrownShape>(prototype / kVariantsPerShape);
    double highest = 0, widest = 0;
    for (const Leaf& leaf : make_tree(prototype)) {
      if (leaf.bark) continue;
      for (const Vec3d& p : leaf.corner) {
        ASSERT_LE(std::hypot(p.x, p.y), crown_radius(shape, p.z));
        highest = std::max(highest, p.z);
        widest = std::max(widest, std::hypot(p.x, p.y));
      }
    }
    EXPECT_GT(highest, 0.9) << prototype;  // and fill it
    EXPECT_GT(widest, 0.9) << prototype;
  }
}

TEST(TreeShapes, variants_differ) { EXPECT_NE(make_tree(0)[50].corner[0].x, make_tree(1)[50].corner[0].x); }

struct Grove {
  Ground ground{{}, 1};
  Solids solids;
  Grove() {
    solids.trees = {plant(CrownShape::ellipsoid, {20, 20, 0}, 9, 6, 1),
                    plant(CrownShape::cone, {40, 20, 0.5}, 14, 5, 2),
                    plant(CrownShape::column, {60, 20, -0.5}, 12, 3, 3)};
  }
};

TEST(Tracer, a_leaf_is_hit_exactly_in_the_plane_of_its_instance) {
  const Grove grove;
  const Tracer tracer(grove.ground, grove.solids, kExtent);
  std::map<int, std::vector<Leaf>> prototypes;
  Random random(4);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const TreeInstance& aim = grove.solids.trees[static_cast<std::size_t>(i % 3)];
    const Vec3d direction{random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), -1};
    const Vec3d through = aim.foot + Vec3d{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(3, 9)};
    const Ray ray{through - 80.0 * direction, direction};
    SurfacePoint hit;
    tracer.first_hits(&ray, 1, &hit);
    if (hit.face != Face::leaf) continue;
    ++hits;
    ASSERT_EQ(class_of(hit, grove.solids), SurfaceClass::tree);
    ASSERT_LE(dot(hit.normal, ray.direction), 0);  // the side that is seen
    // By another way than the tracer's: the leaf's corners, put into the scene, span the plane.
    const TreeInstance& tree = grove.solids.trees[static_cast<std::size_t>(hit.tree)];
    auto& leaves = prototypes[tree.prototype];
    if (leaves.empty()) leaves = make_tree(tree.prototype);
    const Leaf& leaf = leaves[static_cast<std::size_t>(hit.leaf)];
    std::array<Vec3d, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) corner[k] = tree.foot + tree.direction_to_scene(leaf.corner[k]);
    const Vec3d normal = normalized(cross(corner[1] - corner[0], corner[3] - corner[0]));
    ASSERT_NEAR(dot(normal, hit.position - corner[0]), 0, 1e-9);
    ASSERT_NEAR(std::abs(dot(normal, hit.normal)), 1, 1e-9);
    // And within the leaf, to the precision of Embree; a ray that grazes the leaf may land beside it.
    if (std::abs(dot(normal, normalized(direction))) > 0.05)
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3d side = corner[(k + 1) % 4] - corner[k];
        ASSERT_GT(dot(cross(side, hit.position - corner[k]), normal) / norm(side), -1e-3);
      }
  }
  EXPECT_GT(hits, 5000);
}

TEST(Tracer, rays_pass_through_the_gaps_of_a_crown) {
  const Grove grove;
  const Tracer tracer(grove.ground, grove.solids, kExtent);
  for (const TreeInstance& tree : grove.solids.trees) {
    Random random(9);
    int asked = 0, ground = 0;
    while (asked < 4000) {
      const Vec2d q{random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8)};
      if (norm(q) > 0.8) continue;
      ++asked;
      const Ray down{{tree.foot.x + tree.radius_m * q.x, tree.foot.y + tree.radius_m * q.y, 50}, {0, 0, -1}};
      SurfacePoint hit;
      tracer.first_hits(&down, 1, &hit);
      ground += hit.face == Face::ground;
      ASSERT_LE(hit.position.z, tree.foot.z + tree.height_m);
    }
    const double gaps = static_cast<double>(ground) / asked;
    RecordProperty("gaps_" + std::to_string(tree.prototype), std::to_string(gaps));
    EXPECT_GT(gaps, 0.01) << tree.prototype;
    EXPECT_LT(gaps, 0.35) << tree.prototype;
  }
}

}  // namespace
}  // namespace skysweep::scene
