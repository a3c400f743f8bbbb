// SPDX-License-Identifier: Apache-2.0
#include "scene/world/terrain/ground_tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "scene/world/idle_rays.h"
#include "scene/world/terrain/mesh_lines.h"

namespace skysweep::scene {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostVertices = 1e6;
// Single precision, as shares of the size of the scene: what Embree may err by, and what is clearly above the mesh.
constexpr double kEmbreeError = 4e-6, kClearlyAbove = 1e-5;
constexpr double kOnGround_m = 1e-10;  // vertical
constexpr double kNudge_m = 1e-9;      // past the line between two cells

// Index of the stretch between lines[i] and lines[i + 1] that holds `value`, or -1.
int stretch_of(const std::vector<double>& lines, double value) {
  if (!(value >= lines.front() && value < lines.back())) return -1;
  return static_cast<int>(std::upper_bound(lines.begin(), lines.end(), value) - lines.begin()) - 1;
}

// Where a coordinate that starts at `from` and grows by `rate` leaves the stretch.
double leaves(const std::vector<double>& lines, int stretch, double from, double rate) {
  if (rate == 0) return kInfinity;
  return (lines[static_cast<std::size_t>(stretch + (rate > 0))] - from) / rate;
}

// How far a ray may go until a gap that shrinks at rate `closing` can have closed, if its second derivative stays
// within +-bend: the smaller positive root of gap - closing s - bend s^2 / 2.
double safe_step(double gap, double closing, double bend) {
  const double root = std::sqrt(closing * closing + 2 * bend * gap);
  if (closing > 0) return 2 * gap / (closing + root);
  return bend > 0 ? (root - closing) / bend : kInfinity;
}

}  // namespace

struct GroundTracer::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

GroundTracer::GroundTracer(const Ground& ground, const Box2d& extent)
    : ground_(ground), embree_(std::make_unique<Embree>()) {
  const MeshPlan plan = ground.mesh_plan();
  axis_u_ = plan.axis_u;
  Box2d in_uv;
  for (const Vec2d corner : {extent.min, extent.max, Vec2d{extent.min.x, extent.max.y}, {extent.max.x, extent.min.y}})
    in_uv.extend(to_uv(corner));
  const double spacing = std::max(plan.spacing_m, std::sqrt(in_uv.width() * in_uv.height() / kMostVertices));
  std::vector<FineStretch> fine_u, fine_v;
  for (const Ground::Change& change : ground.modifications()) {
    const double fine = change.grid.mesh_plan().spacing_m;
    fine_u.push_back({change.uv.min.x, change.uv.max.x, fine});
    fine_v.push_back({change.uv.min.y, change.uv.max.y, fine});
  }
  u_lines_ = mesh_lines(in_uv.min.x, in_uv.max.x, spacing, plan.u_creases, fine_u);
  v_lines_ = mesh_lines(in_uv.min.y, in_uv.max.y, spacing, {}, fine_v);

  // One thread: the tree, and with it the winner of a tie, is the same everywhere.
  embree_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!embree_->device) throw failure("Embree cannot start on this machine");
  embree_->scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  build_mesh();
  rtcCommitScene(embree_->scene);
  if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE)
    throw failure("Embree cannot build the ground of the scene (its error " + std::to_string(error) + ")");
}

GroundTracer::~GroundTracer() = default;

void GroundTracer::build_mesh() {
  const int columns = static_cast<int>(u_lines_.size()), rows = static_cast<int>(v_lines_.size());
  const Vec2d axis_v{-axis_u_.y, axis_u_.x};
  Array2d<HeightSample> heights(columns, rows);
  double size = std::max(u_lines_.back() - u_lines_.front(), v_lines_.back() - v_lines_.front());
  highest_m_ = -kInfinity;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double u = u_lines_[static_cast<std::size_t>(column)], v = v_lines_[static_cast<std::size_t>(row)];
      const HeightSample here = ground_.at(u * axis_u_ + v * axis_v);
      heights(column, row) = here;
      highest_m_ = std::max(highest_m_, here.z);
      size = std::max({size, std::abs(u), std::abs(v), std::abs(here.z)});
    }
  slack_m_ = kClearlyAbove * size;

  // A plane through three points of a surface with second derivatives up to k leaves it by no more than k L^2 / 8 on
  // their right-angled triangle with the longest side L.
  Array2d<float> deviation(columns - 1, rows - 1), raise(columns, rows);
  curvature_ = band_ = deviation;
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row);
      const Box2d cell{{u_lines_[i], v_lines_[j]}, {u_lines_[i + 1], v_lines_[j + 1]}};
      const Vec2d side = cell.max - cell.min;
      const double curvature = 1.000001 * ground_.curvature(cell);
      double steepest = 0;
      for (const int dj : {0, 1})
        for (const int di : {0, 1}) steepest = std::max(steepest, norm(heights(column + di, row + dj).slope));
      curvature_(column, row) = static_cast<float>(curvature);
      deviation(column, row) =
          static_cast<float>(curvature * dot(side, side) / 8 + kEmbreeError * size * (1 + steepest));
      for (const int dj : {0, 1})
        for (const int di : {0, 1})
          raise(column + di, row + dj) = std::max(raise(column + di, row + dj), deviation(column, row));
    }
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      band_(column, row) = deviation(column, row) + std::max({raise(column, row), raise(column + 1, row),
                                                              raise(column, row + 1), raise(column + 1, row + 1)});
      widest_band_m_ = std::max(widest_band_m_, static_cast<double>(band_(column, row)));
    }

  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_QUAD);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), heights.size()));
  auto* quads = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                               4 * sizeof(unsigned), curvature_.size()));
  if (!vertices || !quads) throw failure("not enough memory for the ground of the scene: make the mapped area smaller");
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double u = u_lines_[static_cast<std::size_t>(column)], v = v_lines_[static_cast<std::size_t>(row)];
      const Vec2d p = u * axis_u_ + v * axis_v;
      *vertices++ = static_cast<float>(p.x);
      *vertices++ = static_cast<float>(p.y);
      *vertices++ = static_cast<float>(heights(column, row).z + raise(column, row));
      if (row == 0 || column == 0) continue;
      const auto here = static_cast<unsigned>(row * columns + column), south = here - static_cast<unsigned>(columns);
      for (const unsigned index : {south - 1, south, here, here - 1}) *quads++ = index;
    }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
}

std::optional<GroundTracer::Cell> GroundTracer::cell_at(Vec2d uv) const {
  const Cell cell{stretch_of(u_lines_, uv.x), stretch_of(v_lines_, uv.y)};
  if (cell.column < 0 || cell.row < 0) return std::nullopt;
  return cell;
}

std::optional<double> GroundTracer::enters(const Ray& ray) const {
  const Vec2d from = to_uv({ray.origin.x, ray.origin.y}), along = to_uv({ray.direction.x, ray.direction.y});
  double first = 0, last = kInfinity;
  const auto cut = [&](double at, double rate, double low, double high) {
    if (rate == 0) {
      if (!(at >= low && at < high)) last = -1;
      return;
    }
    const double to_low = (low - at) / rate, to_high = (high - at) / rate;
    first = std::max(first, std::min(to_low, to_high));
    last = std::min(last, std::max(to_low, to_high));
  };
  cut(from.x, along.x, u_lines_.front(), u_lines_.back());
  cut(from.y, along.y, v_lines_.front(), v_lines_.back());
  if (first >= last) return std::nullopt;
  return first > 0 ? first + kNudge_m / norm(along) : 0;
}

bool GroundTracer::near_ground(const Ray& ray, double t) const {
  const Vec3d p = ray.origin + t * ray.direction;
  if (p.z > highest_m_ + widest_band_m_ + slack_m_) return false;
  const std::optional<Cell> cell = cell_at(to_uv({p.x, p.y}));
  return cell && p.z - ground_.at({p.x, p.y}).z <= band_(cell->column, cell->row) + slack_m_;
}

GroundTracer::Walk GroundTracer::walk(const Ray& ray, double t, double mesh_t, double reach) const {
  const Vec2d origin{ray.origin.x, ray.origin.y}, along{ray.direction.x, ray.direction.y};
  const Vec2d uv_origin = to_uv(origin), uv_along = to_uv(along);
  const double nudge = kNudge_m / std::max(norm(along), 1e-12);
  constexpr int kMostSteps = 1000000;
  for (int i = 0; i < kMostSteps && t <= reach; ++i) {
    const std::optional<Cell> cell = cell_at(uv_origin + t * uv_along);
    if (!cell) return {End::outside, t};
    const Ground::Sample ground = ground_.at(origin + t * along);
    const double gap = ray.origin.z + t * ray.direction.z - ground.z;
    const double closing = dot(ground.slope, along) - ray.direction.z;
    const double step = safe_step(std::max(0.0, gap), closing, curvature_(cell->column, cell->row) * dot(along, along));
    if (gap <= 0) return {End::hit, i == 0 ? step_back_to_root(ray, t) : t};
    if (gap < kOnGround_m && closing > 0) return {End::hit, t + step};
    if (t >= mesh_t && gap > band_(cell->column, cell->row) + slack_m_) return {End::above, t};
    const double exit = std::min(leaves(u_lines_, cell->column, uv_origin.x, uv_along.x),
                                 leaves(v_lines_, cell->row, uv_origin.y, uv_along.y));
    t = t + step < exit ? t + step : std::max(t, exit) + nudge;
  }
  return {End::outside, t};
}

double GroundTracer::step_back_to_root(const Ray& ray, double t) const {
  const auto gap = [&](double at) {
    const Vec3d p = ray.origin + at * ray.direction;
    return p.z - ground_.at({p.x, p.y}).z;
  };
  double above = t, back = slack_m_ / norm(ray.direction);
  while (above > 0 && gap(above) <= 0) {
    above = std::max(0.0, above - back);
    back *= 2;
  }
  double below = t;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (above + below);
    (gap(middle) > 0 ? above : below) = middle;
  }
  return above;
}

std::optional<GroundTracer::Hit> GroundTracer::water_on(const Ray& ray, double reach) const {
  const std::optional<double> level = ground_.water_level_m();
  if (!level || ray.direction.z >= 0 || ray.origin.z <= *level) return std::nullopt;
  const double t = (*level - ray.origin.z) / ray.direction.z;
  const Vec3d p = ray.origin + t * ray.direction;
  if (t > reach || !cell_at(to_uv({p.x, p.y}))) return std::nullopt;
  return Hit{t, true};
}

void GroundTracer::first_hits(const Ray* rays, const bool* active, int count, double reach,
                              std::optional<Hit>* hits) const {
  SKY_CHECK_LE(count, kRayBatch);
  double from[kRayBatch], to[kRayBatch];
  alignas(64) int valid[kRayBatch] = {};
  RTCRayHit16 packet;
  make_idle(packet.ray);
  bool any = false;
  for (int i = 0; i < count; ++i) {
    hits[i].reset();
    if (!active[i]) continue;
    const Ray& ray = rays[i];
    hits[i] = water_on(ray, reach);
    const std::optional<double> entry = enters(ray);
    if (!entry) continue;
    from[i] = *entry;
    to[i] = hits[i] ? hits[i]->t : reach;
    if (near_ground(ray, from[i])) {
      const Walk end = walk(ray, from[i], from[i], to[i]);
      if (end.end == End::hit) hits[i] = Hit{end.t, false};
      if (end.end != End::above) continue;
      from[i] = end.t;
    }
    any = true;
    valid[i] = -1;
    packet.ray.org_x[i] = static_cast<float>(ray.origin.x);
    packet.ray.org_y[i] = static_cast<float>(ray.origin.y);
    packet.ray.org_z[i] = static_cast<float>(ray.origin.z);
    packet.ray.dir_x[i] = static_cast<float>(ray.direction.x);
    packet.ray.dir_y[i] = static_cast<float>(ray.direction.y);
    packet.ray.dir_z[i] = static_cast<float>(ray.direction.z);
    packet.ray.tnear[i] = static_cast<float>(from[i]);
    packet.ray.tfar[i] = static_cast<float>(to[i]);
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0u;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  if (!any) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, embree_->scene, &context, &packet);
  for (int i = 0; i < count; ++i)
    if (valid[i] != 0 && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
      if (const auto t = from_mesh(rays[i], packet.ray.tfar[i], to[i])) hits[i] = Hit{*t, false};
}

std::optional<double> GroundTracer::from_mesh(const Ray& ray, double mesh_t, double reach) const {
  constexpr int kMostDips = 10000;  // below the raised mesh and out again; each is a crest that the ray passes closely
  for (int i = 0; i < kMostDips; ++i) {
    // Embree's distance may be a little long.
    const double start =
        std::max(0.0, mesh_t - kEmbreeError * mesh_t - kEmbreeError / kClearlyAbove * slack_m_ / norm(ray.direction));
    const Walk end = walk(ray, start, mesh_t, reach);
    if (end.end == End::hit) return end.t;
    if (end.end == End::outside) return std::nullopt;
    const std::optional<double> next = next_on_mesh(ray, end.t, reach);
    if (!next) return std::nullopt;
    mesh_t = std::max(*next, end.t);
  }
  return std::nullopt;
}

std::optional<double> GroundTracer::next_on_mesh(const Ray& ray, double from, double reach) const {
  RTCRayHit hit;
  hit.ray.org_x = static_cast<float>(ray.origin.x);
  hit.ray.org_y = static_cast<float>(ray.origin.y);
  hit.ray.org_z = static_cast<float>(ray.origin.z);
  hit.ray.dir_x = static_cast<float>(ray.direction.x);
  hit.ray.dir_y = static_cast<float>(ray.direction.y);
  hit.ray.dir_z = static_cast<float>(ray.direction.z);
  hit.ray.tnear = static_cast<float>(from);
  hit.ray.tfar = static_cast<float>(reach);
  hit.ray.time = 0;
  hit.ray.mask = ~0u;
  hit.ray.flags = 0;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return static_cast<double>(hit.ray.tfar);
}

}  // namespace skysweep::scene
