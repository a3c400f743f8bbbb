// SPDX-License-Identifier: Apache-2.0
#include "scene/world/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "scene/world/idle_rays.h"
#include "scene/world/rolling_ground.h"

namespace skysweep::scene {
namespace {

constexpr int kFacesOfBox = 5;  // top and four walls; nobody sees the bottom
constexpr unsigned kGroundId = 0, kBoxesId = 1, kFacetsId = 2, kFirstTreeId = 16;

// Outward normal and its distance from the box's centre in plan, for faces 1 to 4: +u, +v, -u, -v.
struct Wall {
  Vec2d normal;
  double reach;
};
Wall wall(const SolidBox& box, int face) {
  switch (face) {
    case 1: return {box.axis_u, box.half.x};
    case 2: return {box.axis_v(), box.half.y};
    case 3: return {-1.0 * box.axis_u, box.half.x};
    default: return {-1.0 * box.axis_v(), box.half.y};
  }
}

struct Mesh {
  std::vector<Vec3d> vertices;
  std::vector<unsigned> quads;  // four indices each

  void add_quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    const auto first = static_cast<unsigned>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c, d});
    quads.insert(quads.end(), {first, first + 1, first + 2, first + 3});
  }
};

// Fine enough that the mesh finds the right piece of ground; the exact place comes from the closed form.
Mesh ground_mesh(const Ground& ground, const Box2d& extent) {
  constexpr double kPerWave = 24, kMaxVertices = 4e6;
  Mesh mesh;
  const double longest = std::max(extent.width(), extent.height());
  double spacing = ground.level() ? longest : ground.shortest_wave_m() / kPerWave;
  spacing = std::max(spacing, std::sqrt(extent.width() * extent.height() / kMaxVertices));
  const int columns = 1 + static_cast<int>(std::ceil(extent.width() / spacing));
  const int rows = 1 + static_cast<int>(std::ceil(extent.height() / spacing));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec2d p{extent.min.x + extent.width() * column / (columns - 1),
                    extent.min.y + extent.height() * row / (rows - 1)};
      mesh.vertices.push_back({p.x, p.y, ground.at(p).z});
      if (row == 0 || column == 0) continue;
      const auto here = static_cast<unsigned>(row * columns + column), south = here - static_cast<unsigned>(columns);
      mesh.quads.insert(mesh.quads.end(), {south - 1, south, here, here - 1});
    }
  return mesh;
}

Mesh box_mesh(const std::vector<SolidBox>& boxes) {
  Mesh mesh;
  for (const SolidBox& box : boxes) {
    const auto corner = [&](double u, double v, double z) {
      const Vec2d p = box.center + (u * box.half.x) * box.axis_u + (v * box.half.y) * box.axis_v();
      return Vec3d{p.x, p.y, z};
    };
    const double low = box.z_low, high = box.z_high;
    mesh.add_quad(corner(-1, -1, high), corner(1, -1, high), corner(1, 1, high), corner(-1, 1, high));
    mesh.add_quad(corner(1, -1, low), corner(1, 1, low), corner(1, 1, high), corner(1, -1, high));
    mesh.add_quad(corner(1, 1, low), corner(-1, 1, low), corner(-1, 1, high), corner(1, 1, high));
    mesh.add_quad(corner(-1, 1, low), corner(-1, -1, low), corner(-1, -1, high), corner(-1, 1, high));
    mesh.add_quad(corner(-1, -1, low), corner(1, -1, low), corner(1, -1, high), corner(-1, -1, high));
  }
  return mesh;
}

// One quadrilateral a facet or leaf, in their order.
template <typename Quad>
Mesh corner_mesh(const std::vector<Quad>& quads) {
  Mesh mesh;
  for (const Quad& quad : quads) mesh.add_quad(quad.corner[0], quad.corner[1], quad.corner[2], quad.corner[3]);
  return mesh;
}

void attach(RTCDevice device, RTCScene scene, const Mesh& mesh, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  auto* quads = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                               4 * sizeof(unsigned), mesh.quads.size() / 4));
  if (!vertices || !quads)
    throw failure("not enough memory for the geometry of the scene: make the mapped area smaller");
  for (const Vec3d& v : mesh.vertices)
    for (const double coordinate : {v.x, v.y, v.z}) *vertices++ = static_cast<float>(coordinate);
  std::copy(mesh.quads.begin(), mesh.quads.end(), quads);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

// Distance along the ray to the plane through `point`.
double to_plane(const Ray& ray, Vec3d normal, Vec3d point) {
  return dot(normal, point - ray.origin) / dot(normal, ray.direction);
}

// The same where Embree has met that plane after `met`: that distance itself if the plane's is not within a hand of it.
// A ray along the plane divides by nothing there, and its place is as near the plane as single precision goes.
double to_plane_near(const Ray& ray, Vec3d normal, Vec3d point, float met) {
  constexpr double kHand_m = 0.1;
  const double there = to_plane(ray, normal, point), about = static_cast<double>(met);
  return std::abs(there - about) * norm(ray.direction) <= kHand_m ? there : about;
}

// All 16 lanes are set, so that a packet may be copied.
void prepare(const RayLanes& rays, int count, RTCRayHit16& packet, int* valid) {
  for (int i = 0; i < Tracer::kBatch; ++i) {
    const auto at = static_cast<std::size_t>(i);
    valid[i] = i < count ? -1 : 0;
    packet.ray.org_x[i] = static_cast<float>(rays.ox[at]);
    packet.ray.org_y[i] = static_cast<float>(rays.oy[at]);
    packet.ray.org_z[i] = static_cast<float>(rays.oz[at]);
    packet.ray.dir_x[i] = static_cast<float>(rays.dx[at]);
    packet.ray.dir_y[i] = static_cast<float>(rays.dy[at]);
    packet.ray.dir_z[i] = static_cast<float>(rays.dz[at]);
    packet.ray.tnear[i] = 0;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0u;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace

struct Tracer::Embree {
  RTCDevice device = nullptr;
  RTCDevice unlimited = nullptr;  // see allow_all_threads
  RTCScene scene = nullptr;
  std::array<RTCScene, kTreePrototypes> prototypes{};
  // With instances: incoherent. Embree 3.13.5's other traversal never returns from some packets of shadow rays there.
  RTCIntersectContextFlags traversal = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  ~Embree() {
    rtcReleaseScene(scene);
    for (RTCScene prototype : prototypes)
      if (prototype) rtcReleaseScene(prototype);
    rtcReleaseDevice(device);
    if (unlimited) rtcReleaseDevice(unlimited);
  }

  // As long as a device lives that was made with "threads=1", Embree holds all of oneTBB in this process to one thread,
  // ours included. The largest wish of all devices counts: one that wishes for all threads ends the limit.
  void allow_all_threads() { unlimited = rtcNewDevice("set_affinity=0"); }
};

Tracer::Tracer(const Ground& ground, const Solids& solids, const Box2d& extent)
    : ground_(ground), solids_(solids), embree_(std::make_unique<Embree>()) {
  // One thread: the tree, and with it the winner of a tie, is the same everywhere.
  embree_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!embree_->device) throw failure("Embree cannot start on this machine");
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  if (ground.plain())
    attach(embree_->device, embree_->scene, ground_mesh(ground, extent), kGroundId);
  else
    ground_tracer_ = std::make_unique<GroundTracer>(ground, extent);
  if (!solids.boxes.empty()) attach(embree_->device, embree_->scene, box_mesh(solids.boxes), kBoxesId);
  if (!solids.facets.all.empty()) attach(embree_->device, embree_->scene, corner_mesh(solids.facets.all), kFacetsId);
  if (!solids.trees.empty()) attach_trees();
  rtcCommitScene(embree_->scene);
  if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE)
    throw failure("Embree cannot build the scene (its error " + std::to_string(error) + ")");
  embree_->allow_all_threads();
}

Tracer::~Tracer() = default;

void Tracer::attach_trees() {
  embree_->traversal = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  for (std::size_t i = 0; i < solids_.trees.size(); ++i) {
    const TreeInstance& tree = solids_.trees[i];
    const auto p = static_cast<std::size_t>(tree.prototype);
    RTCScene& prototype = embree_->prototypes[p];
    if (!prototype) {
      prototypes_[p] = make_tree(tree.prototype);
      prototype = rtcNewScene(embree_->device);
      rtcSetSceneFlags(prototype, RTC_SCENE_FLAG_ROBUST);
      attach(embree_->device, prototype, corner_mesh(prototypes_[p]), 0);
      rtcCommitScene(prototype);
    }
    const Vec3d x = tree.direction_to_scene({1, 0, 0}), y = tree.direction_to_scene({0, 1, 0}),
                z = tree.direction_to_scene({0, 0, 1});
    std::array<float, 12> columns{};
    auto out = columns.begin();
    for (const Vec3d& column : {x, y, z, tree.foot})
      for (const double v : {column.x, column.y, column.z}) *out++ = static_cast<float>(v);
    RTCGeometry instance = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, prototype);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(embree_->scene, instance, kFirstTreeId + static_cast<unsigned>(i));
    rtcReleaseGeometry(instance);
  }
}

void Tracer::hit_facet(const Ray& ray, float met, SurfacePoint& hit) const {
  const Facet& facet = solids_.facets.all[static_cast<std::size_t>(hit.facet)];
  hit.face = facet.normal.z > 0 ? Face::top : Face::wall;
  hit.normal = facet.normal;
  hit.position = ray.origin + to_plane_near(ray, facet.normal, facet.corner[0], met) * ray.direction;
  if (facet.normal.z == 1) hit.position.z = facet.corner[0].z;
}

// In the frame of the prototype, where the leaf is known in double: the way along the ray is the same in both frames.
void Tracer::hit_leaf(const Ray& ray, float met, SurfacePoint& hit) const {
  const TreeInstance& tree = solids_.trees[static_cast<std::size_t>(hit.tree)];
  const Leaf& leaf = prototypes_[static_cast<std::size_t>(tree.prototype)][static_cast<std::size_t>(hit.leaf)];
  const Vec3d s = leaf.corner[1] - leaf.corner[0], t = leaf.corner[3] - leaf.corner[0];
  const Ray own{tree.point_to_prototype(ray.origin), tree.direction_to_prototype(ray.direction)};
  hit.face = Face::leaf;
  hit.position = ray.origin + to_plane_near(own, cross(s, t), leaf.corner[0], met) * ray.direction;
  hit.normal = normalized(cross(tree.direction_to_scene(s), tree.direction_to_scene(t)));
  if (dot(hit.normal, ray.direction) > 0) hit.normal = -hit.normal;
}

void Tracer::first_hits(const Ray* rays, int count, SurfacePoint* hits) const {
  SKY_CHECK_LE(count, kBatch);
  alignas(64) int valid[kBatch];
  RTCRayHit16 packet;
  const RayLanes lanes(rays, count);
  prepare(lanes, count, packet, valid);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = embree_->traversal;
  rtcIntersect16(valid, embree_->scene, &context, &packet);

  GroundHits ground;
  if (!ground_tracer_) meet_rolling_ground(ground_.rolling(), lanes, packet.ray.tfar, ground);
  for (int i = 0; i < count; ++i) {
    SurfacePoint& hit = hits[i];
    hit = {};
    const Ray& ray = rays[i];
    if (packet.hit.instID[0][i] != RTC_INVALID_GEOMETRY_ID) {
      hit.tree = static_cast<int>(packet.hit.instID[0][i] - kFirstTreeId);
      hit.leaf = static_cast<int>(packet.hit.primID[i]);
      hit_leaf(ray, packet.ray.tfar[i], hit);
    } else if (packet.hit.geomID[i] == kFacetsId) {
      hit.facet = static_cast<int>(packet.hit.primID[i]);
      hit_facet(ray, packet.ray.tfar[i], hit);
    } else if (packet.hit.geomID[i] == kGroundId) {
      const auto at = static_cast<std::size_t>(i);
      hit.face = Face::ground;
      hit.position = {ground.x[at], ground.y[at], ground.z[at]};
      hit.normal = {ground.nx[at], ground.ny[at], ground.nz[at]};
    } else if (packet.hit.geomID[i] == kBoxesId) {
      hit.box = static_cast<int>(packet.hit.primID[i]) / kFacesOfBox;
      const int face = static_cast<int>(packet.hit.primID[i]) % kFacesOfBox;
      const SolidBox& box = solids_.boxes[static_cast<std::size_t>(hit.box)];
      Vec3d on_face{box.center.x, box.center.y, box.z_high};
      hit.face = face == 0 ? Face::top : Face::wall;
      hit.normal = {0, 0, 1};
      if (face > 0) {
        const Wall side = wall(box, face);
        const Vec2d p = box.center + side.reach * side.normal;
        hit.normal = {side.normal.x, side.normal.y, 0};
        on_face = {p.x, p.y, box.z_high};
      }
      hit.position = ray.origin + to_plane_near(ray, hit.normal, on_face, packet.ray.tfar[i]) * ray.direction;
      if (face == 0) hit.position.z = box.z_high;
    }
  }
  if (ground_tracer_) meet_shaped_ground(rays, count, hits);
}

void Tracer::meet_shaped_ground(const Ray* rays, int count, SurfacePoint* hits) const {
  bool active[kBatch];
  std::fill(active, active + count, true);
  std::optional<GroundTracer::Hit> ground[kBatch];
  ground_tracer_->first_hits(rays, active, count, std::numeric_limits<double>::infinity(), ground);
  for (int i = 0; i < count; ++i) {
    if (!ground[i]) continue;
    const Ray& ray = rays[i];
    SurfacePoint& hit = hits[i];
    if (hit.face != Face::none &&
        dot(hit.position - ray.origin, ray.direction) <= ground[i]->t * dot(ray.direction, ray.direction))
      continue;
    hit = {};
    hit.position = ray.origin + ground[i]->t * ray.direction;
    if (ground[i]->water) {
      hit.face = Face::water;
      hit.position.z = *ground_.water_level_m();
      hit.normal = {0, 0, 1};
    } else {
      hit.face = Face::ground;
      const Vec2d slope = ground_.at({hit.position.x, hit.position.y}).slope;
      hit.normal = normalized(Vec3d{-slope.x, -slope.y, 1});
    }
  }
}

void Tracer::blocked(const Ray* rays, const bool* active, int count, bool endless, bool* out) const {
  SKY_CHECK_LE(count, kBatch);
  alignas(64) int valid[kBatch] = {};
  RTCRay16 packet;
  make_idle(packet);
  bool any = false;
  for (int i = 0; i < count; ++i) {
    out[i] = false;
    if (!active[i]) continue;
    any = true;
    valid[i] = -1;
    packet.org_x[i] = static_cast<float>(rays[i].origin.x);
    packet.org_y[i] = static_cast<float>(rays[i].origin.y);
    packet.org_z[i] = static_cast<float>(rays[i].origin.z);
    packet.dir_x[i] = static_cast<float>(rays[i].direction.x);
    packet.dir_y[i] = static_cast<float>(rays[i].direction.y);
    packet.dir_z[i] = static_cast<float>(rays[i].direction.z);
    packet.tnear[i] = 0;
    packet.tfar[i] = endless ? std::numeric_limits<float>::infinity() : 1.f;
    packet.time[i] = 0;
    packet.mask[i] = ~0u;
    packet.flags[i] = 0;
  }
  if (!any) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = embree_->traversal;
  rtcOccluded16(valid, embree_->scene, &context, &packet);
  for (int i = 0; i < count; ++i) out[i] = active[i] && packet.tfar[i] < 0;
  if (!ground_tracer_) return;
  bool open[kBatch];
  for (int i = 0; i < count; ++i) open[i] = active[i] && !out[i];
  std::optional<GroundTracer::Hit> ground[kBatch];
  ground_tracer_->first_hits(rays, open, count, endless ? std::numeric_limits<double>::infinity() : 1.0, ground);
  for (int i = 0; i < count; ++i) out[i] = out[i] || (open[i] && ground[i]);
}

std::function<int()> Tracer::embree_alone(const std::vector<Ray>& rays) const {
  struct Packet {
    RTCRayHit16 rays;
    alignas(64) int valid[kBatch];
  };
  std::vector<Packet> packets((rays.size() + kBatch - 1) / kBatch);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const int count = static_cast<int>(std::min<std::size_t>(kBatch, rays.size() - i * kBatch));
    prepare(RayLanes(rays.data() + i * kBatch, count), count, packets[i].rays, packets[i].valid);
  }
  return [packets, scene = embree_->scene] {
    int hits = 0;
    for (const Packet& packet : packets) {
      RTCRayHit16 traced = packet.rays;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect16(packet.valid, scene, &context, &traced);
      for (int i = 0; i < kBatch; ++i) hits += packet.valid[i] && traced.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
  };
}

}  // namespace skysweep::scene
