// SPDX-License-Identifier: Apache-2.0
#include "render/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/check.h"
#include "render/bilinear_patch.h"

namespace skysweep::render {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// One horizontal coordinate of a ray, in elements.
struct Axis {
  double origin, rate, inverse;  // elements; elements per metre; metres per element
  int count;                     // of elements at level 0

  Axis(double origin_, double rate_, int count_) : origin(origin_), rate(rate_), inverse(1 / rate_), count(count_) {}
  double at(double t) const { return origin + rate * t; }
  bool grows() const { return rate > 0; }
  // The same border gives the same bits at whatever level it is asked for.
  double time_at(int border) const { return rate == 0 ? kNever : (border - origin) * inverse; }
  double entry() const { return rate == 0 ? -kNever : time_at(grows() ? 0 : count); }
  double exit() const { return time_at(grows() ? count : 0); }
  bool misses() const { return rate == 0 && !(origin >= 0 && origin < count); }
  // Of the square `index` of a level: the border that the ray leaves it by, and that it came in by.
  int far_border(int index, int level) const {
    return grows() ? std::min((index + 1) << level, count) : index << level;
  }
  int near_border(int index, int level) const {
    return grows() ? index << level : std::min((index + 1) << level, count);
  }
  // Which half of a square of level `level` + 1 the ray is in at t.
  int child(int index, int level, double t) const {
    const int middle = (2 * index + 1) << level;
    const bool upper = rate == 0 ? origin >= middle : (t >= time_at(middle)) == grows();
    return std::min(2 * index + (upper ? 1 : 0), ((count - 1) >> level));
  }
};

enum class Side { unknown, above, below };
Side side_of(double height_over_surface) { return height_over_surface >= 0 ? Side::above : Side::below; }

class Traversal {
 public:
  Traversal(const RayCaster& caster, const Ray& ray, const TraceOptions& options)
      : field_(caster.field()),
        hierarchy_(caster.hierarchy()),
        boxes_(caster.form() == SurfaceForm::boxes),
        options_(options),
        origin_(field_.cells_from_map(ray.origin)),
        z_rate_(ray.direction.z),
        // Patches lie between the centres of cells.
        x_(origin_.x - (boxes_ ? 0 : 0.5), ray.direction.x / field_.cell_m, hierarchy_.level(0).width()),
        y_(origin_.y - (boxes_ ? 0 : 0.5), -ray.direction.y / field_.cell_m, hierarchy_.level(0).height()) {}

  Hit run() {
    if (!enter()) return {};
    for (;;) {
      ++steps_;
      t_out_ = std::max(t_, std::min(x_.time_at(x_.far_border(i_, level_)), y_.time_at(y_.far_border(j_, level_))));
      // A plumb ray never leaves its column; any time after the surface will do.
      if (t_out_ == kNever) t_out_ = t_ + plumb_reach();
      const HeightRange range = hierarchy_.level(level_)(i_, j_);
      if (const std::optional<Hit> hit = look_at(range)) return *hit;
      if (descended_) continue;
      if (!advance()) return {};
    }
  }

  std::int64_t steps() const { return steps_; }

 private:
  double z(double t) const { return origin_.z + z_rate_ * t; }
  double plumb_reach() const {
    const HeightRange all = hierarchy_.level(hierarchy_.levels() - 1)(0, 0);
    return all.empty() ? 0 : 1 + std::abs(origin_.z - all.min) + std::abs(origin_.z - all.max);
  }

  // The first square on the way; false if the ray passes beside the field.
  bool enter() {
    if (x_.misses() || y_.misses()) return false;
    const double entry = std::max(x_.entry(), y_.entry());
    t_ = std::max(0.0, entry);
    if (!(t_ < std::min(x_.exit(), y_.exit()))) return false;
    level_ = hierarchy_.levels() - 1;
    i_ = j_ = 0;
    if (!options_.use_hierarchy)
      for (; level_ > 0; descend()) {
      }
    return true;
  }

  void descend() {
    --level_;
    i_ = x_.child(i_, level_, t_);
    j_ = y_.child(j_, level_, t_);
  }

  // Into the next square; a level up with every border of a coarser square. False at the end of the field.
  bool advance() {
    const double tx = x_.time_at(x_.far_border(i_, level_)), ty = y_.time_at(y_.far_border(j_, level_));
    if (std::min(tx, ty) == kNever) return false;
    const int i_before = i_, j_before = j_;
    crossed_x_ = tx <= ty, crossed_y_ = ty <= tx;
    if (crossed_x_) i_ += x_.grows() ? 1 : -1;
    if (crossed_y_) j_ += y_.grows() ? 1 : -1;
    if (!hierarchy_.level(level_).contains(i_, j_)) return false;
    t_ = t_out_;
    if (crossed_x_) border_x_ = x_.near_border(i_, level_);
    if (crossed_y_) border_y_ = y_.near_border(j_, level_);
    const bool coarser_border = (i_ >> 1) != (i_before >> 1) || (j_ >> 1) != (j_before >> 1);
    if (options_.use_hierarchy && coarser_border && level_ + 1 < hierarchy_.levels()) ++level_, i_ >>= 1, j_ >>= 1;
    return true;
  }

  std::optional<Hit> look_at(const HeightRange& range) {
    descended_ = false;
    if (range.empty()) {
      side_ = Side::unknown;
      return std::nullopt;
    }
    const double z_in = z(t_), z_out = z(t_out_);
    if (std::min(z_in, z_out) >= range.max) return pass(Side::above);
    if (std::max(z_in, z_out) < range.min) return pass(Side::below);
    if (level_ == 0) return boxes_ ? look_at_box(range.max, z_in, z_out) : look_at_patch(z_in, z_out);
    if (smaller_than_pixel(range)) return square_hit(range, z_in);
    descend();
    descended_ = true;
    return std::nullopt;
  }

  // By a square that the ray does not touch.
  std::optional<Hit> pass(Side side) {
    if (const auto hit = border_hit(side)) return hit;
    side_ = side;
    return std::nullopt;
  }

  // The border that was just crossed is hit if the side changes there.
  std::optional<Hit> border_hit(Side side) const {
    if (side_ == Side::unknown || side_ == side || !joined_at_border()) return std::nullopt;
    return Hit{t_, 0, !boxes_ ? Face::top : crossed_x_ ? Face::wall_x : Face::wall_y, side_ == Side::below};
  }

  // Whether there is a surface on both sides of the border: a square that was passed may have had some of it only.
  bool joined_at_border() const {
    const Array2d<HeightRange>& elements = hierarchy_.level(0);
    const auto element = [](const Axis& axis, bool crossed, int border, int index, int level, double t, bool before) {
      if (crossed) return axis.grows() == before ? border - 1 : border;
      const int last = std::min((index + 1) << level, axis.count) - 1;
      return std::clamp(static_cast<int>(std::floor(axis.at(t))), index << level, last);
    };
    for (const bool before : {true, false}) {
      const int i = element(x_, crossed_x_, border_x_, i_, level_, t_, before);
      const int j = element(y_, crossed_y_, border_y_, j_, level_, t_, before);
      if (!elements.contains(i, j) || elements(i, j).empty()) return false;
    }
    return true;
  }

  std::optional<Hit> look_at_box(double top, double z_in, double z_out) {
    const Side side = side_of(z_in - top), side_out = side_of(z_out - top);
    if (const auto hit = border_hit(side)) return hit;
    side_ = side_out;
    if (side == side_out) return std::nullopt;
    return Hit{std::clamp(t_ + (top - z_in) / z_rate_, t_, t_out_), 0, Face::top, side == Side::below};
  }

  std::optional<Hit> look_at_patch(double z_in, double z_out) {
    const Array2d<float>& h = field_.height_m;
    const BilinearPatch patch{h(i_, j_), h(i_ + 1, j_), h(i_, j_ + 1), h(i_ + 1, j_ + 1)};
    const auto inside = [&](double t) {
      return Vec2d{std::clamp(x_.at(t) - i_, 0.0, 1.0), std::clamp(y_.at(t) - j_, 0.0, 1.0)};
    };
    const Vec2d from = inside(t_), to = inside(t_out_);
    const Side side = side_of(z_in - patch.at(from));
    if (const auto hit = border_hit(side)) return hit;
    if (const auto share = first_crossing(patch, from, z_in, to, z_out))
      return Hit{t_ + *share * (t_out_ - t_), 0, Face::top, side == Side::below};
    side_ = side_of(z_out - patch.at(to));
    return std::nullopt;
  }

  bool smaller_than_pixel(const HeightRange& range) const {
    const double side = (1 << level_) * field_.cell_m, rise = static_cast<double>(range.max) - range.min;
    const double pixel = options_.pixel.at(t_);
    return 2 * side * side + rise * rise < pixel * pixel;
  }

  Hit square_hit(const HeightRange& range, double z_in) const {
    const double level_z = std::clamp(z_in, static_cast<double>(range.min), static_cast<double>(range.max));
    const double t = level_z == z_in ? t_ : std::clamp(t_ + (level_z - z_in) / z_rate_, t_, t_out_);
    return {t, level_, Face::square, side_ == Side::below || (side_ == Side::unknown && z_in < range.min)};
  }

  const HeightField& field_;
  const HeightHierarchy& hierarchy_;
  const bool boxes_;
  const TraceOptions& options_;
  const Vec3d origin_;
  const double z_rate_;
  const Axis x_, y_;

  int level_ = 0, i_ = 0, j_ = 0;  // the square looked at
  double t_ = 0, t_out_ = 0;       // the ray comes in and leaves, metres
  Side side_ = Side::unknown;      // of the surface, where the ray comes in
  bool crossed_x_ = false, crossed_y_ = false, descended_ = false;
  int border_x_ = 0, border_y_ = 0;  // crossed on coming in
  std::int64_t steps_ = 0;
};

}  // namespace

RayCaster::RayCaster(std::shared_ptr<const HeightField> field, SurfaceForm form)
    : field_(std::move(field)), form_(form), hierarchy_(*field_, form) {
  SKY_CHECK(!field_->height_m.empty());
}

Hit RayCaster::first_hit(const Ray& ray, const TraceOptions& options, std::int64_t* steps) const {
  Traversal traversal(*this, ray, options);
  const Hit hit = traversal.run();
  if (steps) *steps += traversal.steps();
  return hit;
}

}  // namespace skysweep::render
