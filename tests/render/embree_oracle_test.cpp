// SPDX-License-Identifier: Apache-2.0
// The ray caster against Embree with the same surface as triangles: boxes as they are, bilinear patches cut into
// 24 x 24 squares, which departs from them by at most |twist| / (4 * 24^2): 0.003 cells beside the spikes of 6 m.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "render/bilinear_patch.h"
#include "render/landscapes.h"
#include "render/ray_caster.h"

namespace skysweep::render {
namespace {

constexpr int kCuts = 24;
constexpr int kWidth = 80, kHeight = 60;

// Triangles in cells from the north-west corner, x eastwards, y southwards, z in metres, all as floats of small
// numbers.
class Oracle {
 public:
  Oracle(const HeightField& field, SurfaceForm form) : field_(field) {
    form == SurfaceForm::boxes ? add_boxes() : add_patches();
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices_.size()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      vertices[3 * i] = static_cast<float>(vertices_[i].x);
      vertices[3 * i + 1] = static_cast<float>(vertices_[i].y);
      vertices[3 * i + 2] = static_cast<float>(vertices_[i].z);
    }
    const std::size_t quads = vertices_.size() / 4;
    auto* triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2 * quads));
    for (unsigned q = 0; q < quads; ++q)
      for (const unsigned corner : {0u, 1u, 2u, 2u, 1u, 3u}) *triangles++ = 4 * q + corner;
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene_, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene_);
  }
  ~Oracle() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  // Distance in metres; infinite for a miss.
  double distance(const Ray& ray) const {
    const Vec3d o = field_.cells_from_map(ray.origin);
    const Vec3d d{ray.direction.x / field_.cell_m, -ray.direction.y / field_.cell_m, ray.direction.z};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r{};
    r.ray.org_x = static_cast<float>(o.x), r.ray.org_y = static_cast<float>(o.y), r.ray.org_z = static_cast<float>(o.z);
    r.ray.dir_x = static_cast<float>(d.x), r.ray.dir_y = static_cast<float>(d.y), r.ray.dir_z = static_cast<float>(d.z);
    r.ray.tfar = std::numeric_limits<float>::infinity();
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &r);
    return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity() : r.ray.tfar;
  }

 private:
  bool there(int x, int y) const { return field_.kind.contains(x, y) && field_.kind(x, y) != CellKind::outside; }
  double h(int x, int y) const { return field_.height_m(x, y); }
  void add_quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d) { vertices_.insert(vertices_.end(), {a, b, c, d}); }

  void add_boxes() {
    for (int y = 0; y < field_.kind.height(); ++y)
      for (int x = 0; x < field_.kind.width(); ++x) {
        if (!there(x, y)) continue;
        const double l = x, t = y, z = h(x, y);
        add_quad({l, t, z}, {l + 1, t, z}, {l, t + 1, z}, {l + 1, t + 1, z});
        if (there(x + 1, y))
          add_quad({l + 1, t, z}, {l + 1, t + 1, z}, {l + 1, t, h(x + 1, y)}, {l + 1, t + 1, h(x + 1, y)});
        if (there(x, y + 1))
          add_quad({l, t + 1, z}, {l + 1, t + 1, z}, {l, t + 1, h(x, y + 1)}, {l + 1, t + 1, h(x, y + 1)});
      }
  }

  void add_patches() {
    for (int y = 0; y + 1 < field_.kind.height(); ++y)
      for (int x = 0; x + 1 < field_.kind.width(); ++x) {
        if (!there(x, y) || !there(x + 1, y) || !there(x, y + 1) || !there(x + 1, y + 1)) continue;
        const auto point = [&](int i, int j) {
          const double u = 1. * i / kCuts, v = 1. * j / kCuts;
          const double z =
              (1 - v) * ((1 - u) * h(x, y) + u * h(x + 1, y)) + v * ((1 - u) * h(x, y + 1) + u * h(x + 1, y + 1));
          return Vec3d{x + 0.5 + u, y + 0.5 + v, z};
        };
        for (int j = 0; j < kCuts; ++j)
          for (int i = 0; i < kCuts; ++i) add_quad(point(i, j), point(i + 1, j), point(i, j + 1), point(i + 1, j + 1));
      }
  }

  const HeightField& field_;
  std::vector<Vec3d> vertices_;  // four a quad
  RTCDevice device_;
  RTCScene scene_;
};

struct Viewpoint {
  std::string name;
  Vec3d eye, target;  // metres from the north-west corner of the landscape: x east, y north (so negative inside), z up
  double field_of_view_deg = 50;
};

// The landscape spans 0..19.5 east, -17..0 north.
std::vector<Viewpoint> viewpoints() {
  std::vector<Viewpoint> all = {
      {"plumb", {10, -8.5, 40}, {10, -8.5001, 0}, 30},
      {"plumb_near", {7.5, -11, 9}, {7.5, -11.0001, 0}, 70},
      {"grazing_from_west", {-30, -8, 4}, {10, -8.3, 1}, 30},
      {"grazing_from_south", {9, -45, 3}, {9.3, -8, 1.5}, 30},
      {"grazing_along_cell_borders", {-20, -8, 6}, {20, -8, 0}, 40},
      {"along_the_diagonal", {-10, 10, 12}, {10, -10, 0}, 45},
      {"level_at_roof_height", {-12, -6, 5}, {12, -6.2, 5}, 40},
      {"inside_the_box", {4, -12, 2.9}, {14, -4, 1}, 80},
      {"inside_beside_a_spike", {3, -3, 4}, {3.9, -3.8, 3}, 80},
      {"inside_the_well", {7.75, -13.75, 0.2}, {9, -12, 2}, 90},
      {"under_ground_looking_up", {10, -8, -8}, {10.1, -8.1, 0}, 80},
      {"under_ground_looking_aside", {2, -14, -3}, {14, -4, 0.3}, 70},
      {"under_the_house", {12, -6, 2}, {14, -8, 4}, 100},
      {"out_of_the_notch", {13, -25, 1}, {13, -15, 0}, 60},
      {"hole_from_near", {8, -18, 5}, {8.2, -11, 0}, 50},
      {"from_afar", {500, 700, 600}, {10, -8, 0}, 2.2},
  };
  for (int i = 0; i < 6; ++i) {
    const double a = i * std::numbers::pi / 3 + 0.1;
    all.push_back(
        {"around_" + std::to_string(i), {10 + 25 * std::cos(a), -8 + 25 * std::sin(a), 14. - 2 * i}, {10, -8, 0}, 45});
  }
  return all;
}

std::vector<Ray> rays_of(const Viewpoint& view, Vec2d corner) {
  const Vec3d forward = normalized(view.target - view.eye);
  const Vec3d right = normalized(cross(forward, {0, 0, 1})), up = cross(right, forward);
  const double scale = std::tan(view.field_of_view_deg / 2 * std::numbers::pi / 180) / (kWidth / 2.);
  std::vector<Ray> rays;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      rays.push_back(
          {{view.eye.x + corner.x, view.eye.y + corner.y, view.eye.z},
           normalized(forward + scale * (x + 0.5 - kWidth / 2.) * right + scale * (kHeight / 2. - y - 0.5) * up)});
  return rays;
}

// A pixel is away from silhouettes if the oracle's distances around it differ by less than half a metre (a cell) and
// all of them are hits or all of them misses.
bool away_from_silhouettes(const std::vector<double>& distance, int x, int y) {
  if (x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1) return false;
  double low = distance[static_cast<std::size_t>(y * kWidth + x)], high = low;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const double d = distance[static_cast<std::size_t>((y + dy) * kWidth + x + dx)];
      low = std::min(low, d), high = std::max(high, d);
    }
  return std::isinf(low) || high - low < 0.5;
}

class EmbreeOracle : public testing::TestWithParam<SurfaceForm> {};

TEST_P(EmbreeOracle, depths_agree_to_a_hundredth_of_a_cell_and_hits_are_hits) {
  // The oracle sees coordinates that small floats hold; the caster those of a map 10^7 m from the origin.
  const Vec2d corner{1e7 + 0.25, 9999744.5};
  const auto field = hard_landscape(corner);
  const RayCaster caster(field, GetParam());
  const Oracle oracle(*field, GetParam());
  int compared = 0, apart = 0, wrong_hits = 0, wrong_at_silhouettes = 0, rays_cast = 0;
  for (const Viewpoint& view : viewpoints()) {
    const std::vector<Ray> rays = rays_of(view, corner);
    std::vector<double> expected;
    for (const Ray& ray : rays) expected.push_back(oracle.distance(ray));
    int hits = 0, apart_here = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * kWidth + x);
        const Hit hit = caster.first_hit(rays[i]);
        ++rays_cast;
        hits += hit.any();
        const bool differs = hit.any() == std::isinf(expected[i]);
        if (!away_from_silhouettes(expected, x, y)) {
          wrong_at_silhouettes += differs;
          continue;
        }
        ++compared;
        wrong_hits += differs;
        if (!differs && hit.any()) apart_here += std::abs(hit.distance_m - expected[i]) > 0.01 * field->cell_m;
      }
    EXPECT_GT(hits, kWidth * kHeight / 20) << view.name;
    EXPECT_LE(apart_here, kWidth * kHeight / 100) << view.name;
    apart += apart_here;
  }
  EXPECT_EQ(wrong_hits, 0);
  EXPECT_LE(apart, compared / 1000) << compared;
  EXPECT_LE(wrong_at_silhouettes, rays_cast / 1000);
  RecordProperty("compared", compared);
  RecordProperty("apart", apart);
  RecordProperty("wrong_at_silhouettes", wrong_at_silhouettes);
}

INSTANTIATE_TEST_SUITE_P(Forms, EmbreeOracle, testing::Values(SurfaceForm::boxes, SurfaceForm::bilinear),
                         [](const auto& tested) { return tested.param == SurfaceForm::boxes ? "boxes" : "bilinear"; });

}  // namespace
}  // namespace skysweep::render
