// SPDX-License-Identifier: Apache-2.0
// The ray caster (render/ray_caster.cpp), step for step and in double precision, one thread a ray.
//
// Constants: THREADS, BOXES (1: boxes, 0: bilinear patches), UNKNOWN_SIDE, ABOVE, BELOW, FACE_TOP, FACE_WALL_X,
// FACE_WALL_Y, FACE_SQUARE, MOST_STEPS (no ray takes so many; ends a thread that a faulty driver would keep running).

layout(local_size_x = THREADS) in;
// Of each ray: origin x, y in elements and z in metres, then the same a metre along it.
layout(std430, binding = 0) readonly buffer Rays { double rays[]; };
// Of each level: where its squares begin, how many there are across and down, nothing.
layout(std430, binding = 1) readonly buffer Levels { ivec4 levels[]; };
layout(std430, binding = 2) readonly buffer Ranges { vec2 ranges[]; };  // lowest, highest; lowest above highest: empty
layout(std430, binding = 3) readonly buffer Heights { float heights[]; };
layout(std430, binding = 4) writeonly buffer Distances { double distances[]; };  // NEVER: nothing was hit
layout(std430, binding = 5) writeonly buffer Found { ivec2 found[]; };  // level, face and side in one; steps
layout(std430, binding = 6) readonly buffer Numbers { double numbers[]; };  // pixel fixed_m, per_metre; side of a cell
uniform int ray_count, level_count, use_hierarchy, heights_across;

const double NEVER = 1e300lf;

struct Axis {
  double origin, rate, inverse;
  int count;
};

double at(Axis axis, double t) { return axis.origin + axis.rate * t; }
bool grows(Axis axis) { return axis.rate > 0.0lf; }
double time_at(Axis axis, int border) {
  return axis.rate == 0.0lf ? NEVER : (double(border) - axis.origin) * axis.inverse;
}
int far_border(Axis axis, int index, int level) {
  return grows(axis) ? min((index + 1) << level, axis.count) : index << level;
}
int near_border(Axis axis, int index, int level) {
  return grows(axis) ? index << level : min((index + 1) << level, axis.count);
}
int child_of(Axis axis, int index, int level, double t) {
  int middle = (2 * index + 1) << level;
  bool upper = axis.rate == 0.0lf ? axis.origin >= double(middle) : (t >= time_at(axis, middle)) == grows(axis);
  return min(2 * index + (upper ? 1 : 0), (axis.count - 1) >> level);
}

// The walk of this thread.
Axis x_axis, y_axis;
double z_origin, z_rate, t_in, t_out;
int level, i, j, side, border_x, border_y, steps;
bool crossed_x, crossed_y;
// What it found.
double hit_distance;
int hit_level, hit_face;
bool hit_from_below;

vec2 range_at(int of_level, int x, int y) {
  ivec4 l = levels[of_level];
  return ranges[l.x + y * l.y + x];
}
double z_at(double t) { return z_origin + z_rate * t; }
int side_of(double height_over_surface) { return height_over_surface >= 0.0lf ? ABOVE : BELOW; }

bool found_at(double t, int of_level, int face, bool from_below) {
  hit_distance = t;
  hit_level = of_level;
  hit_face = face;
  hit_from_below = from_below;
  return true;
}

int element_beside(Axis axis, bool crossed, int border, int index, bool before) {
  if (crossed) return grows(axis) == before ? border - 1 : border;
  int last = min((index + 1) << level, axis.count) - 1;
  return clamp(int(floor(at(axis, t_in))), index << level, last);
}

bool joined_at_border() {
  for (int k = 0; k < 2; ++k) {
    int x = element_beside(x_axis, crossed_x, border_x, i, k == 0);
    int y = element_beside(y_axis, crossed_y, border_y, j, k == 0);
    if (x < 0 || y < 0 || x >= x_axis.count || y >= y_axis.count) return false;
    vec2 range = range_at(0, x, y);
    if (range.x > range.y) return false;
  }
  return true;
}

bool border_hit(int new_side) {
  if (side == UNKNOWN_SIDE || side == new_side || !joined_at_border()) return false;
  int face = BOXES == 0 ? FACE_TOP : crossed_x ? FACE_WALL_X : FACE_WALL_Y;
  return found_at(t_in, 0, face, side == BELOW);
}

bool pass_by(int new_side) {
  if (border_hit(new_side)) return true;
  side = new_side;
  return false;
}

bool look_at_box(double top, double z_in, double z_out) {
  int in_side = side_of(z_in - top), out_side = side_of(z_out - top);
  if (border_hit(in_side)) return true;
  side = out_side;
  if (in_side == out_side) return false;
  return found_at(clamp(t_in + (top - z_in) / z_rate, t_in, t_out), 0, FACE_TOP, in_side == BELOW);
}

// render/bilinear_patch.h; -1: none.
double first_sign_change(double a, double b, double c) {
  bool above = c >= 0.0lf;
  if ((a + b + c >= 0.0lf) == above) {
    if (a == 0.0lf) return -1.0lf;
    double vertex = -b / (2.0lf * a);
    if (!(vertex > 0.0lf && vertex < 1.0lf) || (c + vertex * (b + vertex * a) >= 0.0lf) == above) return -1.0lf;
  }
  double root = sqrt(max(0.0lf, b * b - 4.0lf * a * c));
  double sum = -0.5lf * (b + (b < 0.0lf ? -root : root));
  double first = 2.0lf;
  if (a != 0.0lf) {
    double q = sum / a;
    if (q >= 0.0lf && q < first) first = q;
  }
  double q = sum != 0.0lf ? c / sum : 0.0lf;
  if (q >= 0.0lf && q < first) first = q;
  return min(first, 1.0lf);
}

bool look_at_patch(double z_in, double z_out) {
  int corner = j * heights_across + i;
  double h00 = heights[corner], h10 = heights[corner + 1];
  double h01 = heights[corner + heights_across], h11 = heights[corner + heights_across + 1];
  double twist = h00 - h10 - h01 + h11;
  dvec2 from = clamp(dvec2(at(x_axis, t_in) - double(i), at(y_axis, t_in) - double(j)), dvec2(0.0lf), dvec2(1.0lf));
  dvec2 to = clamp(dvec2(at(x_axis, t_out) - double(i), at(y_axis, t_out) - double(j)), dvec2(0.0lf), dvec2(1.0lf));
  double c = z_in - (h00 + from.x * (h10 - h00) + from.y * (h01 - h00) + from.x * from.y * twist);
  double end = z_out - (h00 + to.x * (h10 - h00) + to.y * (h01 - h00) + to.x * to.y * twist);
  int in_side = side_of(c);
  if (border_hit(in_side)) return true;
  double a = -twist * (to.x - from.x) * (to.y - from.y);
  double share = first_sign_change(a, end - c - a, c);
  if (share >= 0.0lf) return found_at(t_in + share * (t_out - t_in), 0, FACE_TOP, in_side == BELOW);
  side = side_of(end);
  return false;
}

bool square_hit(vec2 range, double z_in) {
  double level_z = clamp(z_in, double(range.x), double(range.y));
  double t = level_z == z_in ? t_in : clamp(t_in + (level_z - z_in) / z_rate, t_in, t_out);
  return found_at(t, level, FACE_SQUARE, side == BELOW || (side == UNKNOWN_SIDE && z_in < double(range.x)));
}

bool smaller_than_pixel(vec2 range) {
  double across = double(1 << level) * numbers[2], rise = double(range.y) - double(range.x);
  double pixel = numbers[0] + numbers[1] * t_in;
  return 2.0lf * across * across + rise * rise < pixel * pixel;
}

void descend() {
  --level;
  i = child_of(x_axis, i, level, t_in);
  j = child_of(y_axis, j, level, t_in);
}

bool enter() {
  if (x_axis.rate == 0.0lf && !(x_axis.origin >= 0.0lf && x_axis.origin < double(x_axis.count))) return false;
  if (y_axis.rate == 0.0lf && !(y_axis.origin >= 0.0lf && y_axis.origin < double(y_axis.count))) return false;
  t_in = 0.0lf;
  if (x_axis.rate != 0.0lf) t_in = max(t_in, time_at(x_axis, grows(x_axis) ? 0 : x_axis.count));
  if (y_axis.rate != 0.0lf) t_in = max(t_in, time_at(y_axis, grows(y_axis) ? 0 : y_axis.count));
  double end = min(time_at(x_axis, grows(x_axis) ? x_axis.count : 0), time_at(y_axis, grows(y_axis) ? y_axis.count : 0));
  if (!(t_in < end)) return false;
  level = level_count - 1;
  i = j = 0;
  if (use_hierarchy == 0)
    while (level > 0) descend();
  return true;
}

bool advance() {
  double tx = time_at(x_axis, far_border(x_axis, i, level)), ty = time_at(y_axis, far_border(y_axis, j, level));
  if (min(tx, ty) == NEVER) return false;
  int i_before = i, j_before = j;
  crossed_x = tx <= ty;
  crossed_y = ty <= tx;
  if (crossed_x) i += grows(x_axis) ? 1 : -1;
  if (crossed_y) j += grows(y_axis) ? 1 : -1;
  if (i < 0 || j < 0 || i >= levels[level].y || j >= levels[level].z) return false;
  t_in = t_out;
  if (crossed_x) border_x = near_border(x_axis, i, level);
  if (crossed_y) border_y = near_border(y_axis, j, level);
  bool coarser_border = (i >> 1) != (i_before >> 1) || (j >> 1) != (j_before >> 1);
  if (use_hierarchy != 0 && coarser_border && level + 1 < level_count) {
    ++level;
    i >>= 1;
    j >>= 1;
  }
  return true;
}

bool walk() {
  if (!enter()) return false;
  vec2 all = range_at(level_count - 1, 0, 0);
  double plumb_reach = all.x > all.y ? 0.0lf : 1.0lf + abs(z_origin - double(all.x)) + abs(z_origin - double(all.y));
  for (steps = 1; steps < MOST_STEPS; ++steps) {
    t_out = max(t_in, min(time_at(x_axis, far_border(x_axis, i, level)), time_at(y_axis, far_border(y_axis, j, level))));
    if (t_out == NEVER) t_out = t_in + plumb_reach;
    vec2 range = range_at(level, i, j);
    double z_in = z_at(t_in), z_out = z_at(t_out);
    if (range.x > range.y) {
      side = UNKNOWN_SIDE;
    } else if (min(z_in, z_out) >= double(range.y)) {
      if (pass_by(ABOVE)) return true;
    } else if (max(z_in, z_out) < double(range.x)) {
      if (pass_by(BELOW)) return true;
    } else if (level == 0) {
#if BOXES
      if (look_at_box(double(range.y), z_in, z_out)) return true;
#else
      if (look_at_patch(z_in, z_out)) return true;
#endif
    } else if (smaller_than_pixel(range)) {
      return square_hit(range, z_in);
    } else {
      descend();
      continue;
    }
    if (!advance()) return false;
  }
  return false;
}

void main() {
  int ray = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * THREADS + gl_LocalInvocationID.x);
  if (ray >= ray_count) return;
  x_axis = Axis(rays[6 * ray], rays[6 * ray + 3], 1.0lf / rays[6 * ray + 3], levels[0].y);
  y_axis = Axis(rays[6 * ray + 1], rays[6 * ray + 4], 1.0lf / rays[6 * ray + 4], levels[0].z);
  z_origin = rays[6 * ray + 2];
  z_rate = rays[6 * ray + 5];
  side = UNKNOWN_SIDE;
  crossed_x = crossed_y = false;
  border_x = border_y = steps = 0;
  bool hit = walk();
  distances[ray] = hit ? hit_distance : NEVER;
  found[ray] = ivec2(hit ? hit_level | hit_face << 8 | (hit_from_below ? 1 << 16 : 0) : 0, steps);
}
