// SPDX-License-Identifier: Apache-2.0
// The matching cost of a cell at a plane (sweep/view_costs.h), one thread a cell, one work group a block of cells.
//
// Constants: VIEWS, LEVELS (window levels), AGGREGATION (0 all views, 1 better half, 2 consensus), MIN_VIEWS, CHUNK
// (planes that a work group projects at once), BLOCK (cells along a block's side), and those of sweep/gpu/engine.cpp.
// ALL_VIEWS(f), ALL_PAIRS(f) and ALL_LEVELS(f) call f for every view, every two views and every level: one after the
// other with constant numbers where there are few, so that what a thread keeps stays in registers.

layout(local_size_x = BLOCK, local_size_y = BLOCK) in;

// North-west corner x, y, cell, dz; then of each view 22 numbers: cam_from_world by rows, centre, fx, fy, cx, cy, squared
// fold radius, k1, k2, p1, p2, k3.
layout(std430, binding = 0) readonly buffer Geometry { double geometry[]; };

struct Level {
  vec4 place;  // where its pixel (0, 0) lies in its layer; its last column and row
  vec4 scale;  // pixels of the level for one of the photograph; gain and offset of the view; the rest is not used
};
struct View {
  vec4 lens;   // fx, fy, squared fold radius, 1 if there is distortion
  vec4 radial; // k1, k2, k3; layer
  vec4 tangential;  // p1, p2; width, height of the photograph
  vec4 east;   // a cell to the east in the camera's frame
  vec4 south;  // and one to the south
  Level levels[LEVELS];
};
layout(std140, binding = 0) uniform Views { View views[VIEWS]; };
layout(binding = 0) uniform sampler2DArray atlas;

uniform float texel_width, texel_height;  // of the atlas, which is 1 wide and high
uniform float few_views_penalty;          // grey levels
uniform float consensus_share;
#if HORIZONS
// The lowest height that each view sees past the surface (sweep/horizons.h), view after view, row by row.
layout(std430, binding = 4) readonly buffer Horizons { float lowest_visible[]; };
uniform int horizon_times;      // cells along one of theirs
uniform int horizon_first_row;  // of the grid, in cells of the grid, from their first one
uniform int horizon_width, horizon_cells;
uniform float hidden_cost;
#endif

const int VIEW_NUMBERS = 22;

// Where a view shows a block at one plane: exactly in its middle, in double precision once for the block; cells follow
// by differences small enough for single precision.
struct Place {
  float depth;     // of the middle; BEHIND: the block is behind the camera; CELL_BY_CELL: the differences do not hold
  vec2 base;       // whole pixel of the middle
  vec2 remainder;  // and what is beyond it
  vec2 normal;     // x / z, y / z of the middle, without distortion
};
const float BEHIND = 0, CELL_BY_CELL = -1;
shared Place places[CHUNK * VIEWS];

double number(int view, int i) { return geometry[4 + view * VIEW_NUMBERS + i]; }

dvec3 in_camera(int view, dvec3 world) {
  dvec3 p = world - dvec3(number(view, 9), number(view, 10), number(view, 11));
  return dvec3(number(view, 0) * p.x + number(view, 1) * p.y + number(view, 2) * p.z,
               number(view, 3) * p.x + number(view, 4) * p.y + number(view, 5) * p.z,
               number(view, 6) * p.x + number(view, 7) * p.y + number(view, 8) * p.z);
}

dvec2 pixel_of(int view, dvec2 n) {
  double r2 = n.x * n.x + n.y * n.y;
  double radial = 1.0lf + r2 * (number(view, 17) + r2 * (number(view, 18) + r2 * number(view, 21)));
  double p1 = number(view, 19), p2 = number(view, 20), xy2 = 2.0lf * n.x * n.y;
  dvec2 d = dvec2(n.x * radial + p1 * xy2 + p2 * (r2 + 2.0lf * n.x * n.x),
                  n.y * radial + p2 * xy2 + p1 * (r2 + 2.0lf * n.y * n.y));
  return dvec2(d.x * number(view, 12) + number(view, 14), d.y * number(view, 13) + number(view, 15));
}

// `east`, `south`: cells from the grid's north-west corner.
dvec3 ground(double east, double south, int plane) {
  return dvec3(geometry[0] + east * geometry[2], geometry[1] - south * geometry[2], double(plane) * geometry[3]);
}

Place place_of(int view, ivec2 block, int plane) {
  Place place = Place(BEHIND, vec2(0), vec2(0), vec2(0));
  dvec3 q = in_camera(view, ground(double(block.x * BLOCK + BLOCK / 2), double(block.y * BLOCK + BLOCK / 2), plane));
  double change = double(BLOCK / 2) * double(abs(views[view].east.z) + abs(views[view].south.z));  // within the block
  if (q.z < -1.01lf * change) return place;
  place.depth = CELL_BY_CELL;
  if (q.z < 4.0lf * change) return place;
  dvec2 n = q.xy / q.z;
  dvec2 pixel = pixel_of(view, n);
  // Beyond these the differences are too coarse, or whole numbers too large.
  if (!(max(abs(pixel.x), abs(pixel.y)) < 1e6lf)) return place;
  dvec2 whole = floor(pixel);
  return Place(float(q.z), vec2(whole), vec2(pixel - whole), vec2(n));
}

// All threads of the group: fills `places` for `count` planes from `first` on.
void find_places(ivec2 block, int first, int count) {
  for (int i = int(gl_LocalInvocationIndex); i < count * VIEWS; i += BLOCK * BLOCK)
    places[i] = place_of(i % VIEWS, block, first + i / VIEWS);
  barrier();
}

// The change of a position in the photograph where the normalised one changes from n by d: only differences of
// polynomials, so that nothing is lost to cancellation.
vec2 distorted_change(int v, vec2 n, vec2 d) {
  vec3 k = views[v].radial.xyz;
  vec2 p = views[v].tangential.xy;
  float r0 = dot(n, n), e = dot(2 * n + d, d), r2 = r0 + e;
  float radial = 1 + r2 * (k.x + r2 * (k.y + r2 * k.z));
  float radial_change = e * (k.x + k.y * (r2 + r0) + k.z * (r2 * r2 + r2 * r0 + r0 * r0));
  float xy2 = 2 * (n.x * d.y + n.y * d.x + d.x * d.y);
  vec2 squares = d * (2 * n + d);  // change of x^2, y^2
  return d * radial + n * radial_change + vec2(p.x * xy2 + p.y * (e + 2 * squares.x), p.y * xy2 + p.x * (e + 2 * squares.y));
}

// A position in a photograph: whole pixel x, y and the rest. Not on the photograph: NOT_SHOWN in x.
const float NOT_SHOWN = -1e9;

vec4 position_in_double(int v, ivec2 cell, int plane) {
  const vec4 nowhere = vec4(NOT_SHOWN, 0, 0, 0);
  dvec3 q = in_camera(v, ground(double(cell.x) + 0.5lf, double(cell.y) + 0.5lf, plane));
  if (!(q.z > 0.0lf)) return nowhere;
  dvec2 n = q.xy / q.z;
  if (!(dot(n, n) < number(v, 16))) return nowhere;
  dvec2 pixel = pixel_of(v, n);
  dvec2 size = dvec2(views[v].tangential.zw);
  if (!(pixel.x >= 0.0lf && pixel.y >= 0.0lf && pixel.x <= size.x && pixel.y <= size.y)) return nowhere;
  dvec2 whole = floor(pixel);
  return vec4(vec2(whole), vec2(pixel - whole));
}

vec4 position_by_differences(int v, Place place, vec2 from_middle) {
  const vec4 nowhere = vec4(NOT_SHOWN, 0, 0, 0);
  vec3 change = from_middle.x * views[v].east.xyz + from_middle.y * views[v].south.xyz;
  vec2 d = (change.xy - place.normal * change.z) / (place.depth + change.z);
  if (views[v].lens.w != 0) {
    vec2 n = place.normal + d;
    if (!(dot(n, n) < views[v].lens.z)) return nowhere;
    d = distorted_change(v, place.normal, d);
  }
  vec2 rest = place.remainder + views[v].lens.xy * d;
  vec2 least = -place.base, most = views[v].tangential.zw - place.base;
  if (!(rest.x >= least.x && rest.y >= least.y && rest.x <= most.x && rest.y <= most.y)) return nowhere;
  return vec4(place.base, rest);
}

// What a thread knows about its cell at one plane.
float luminance[VIEWS * LEVELS];  // 0 to 1
float shown[VIEWS];               // 1 or 0
float cost[VIEWS];                // C_k
vec4 exact[VIEWS];                // positions of views whose place is CELL_BY_CELL
float n;                          // views that show it
float hidden;                     // and those from which it would be seen, did nothing stand between
float mean, limit, used, per_reach, weights, squares;
vec4 position;
int place_number;
vec2 from_middle;
int horizon_cell;
float height_m;  // of the plane

// Bilinear luminance, 0 to 1, with weights of full precision: the four pixels come in one gather, addressed by the
// corner that they share.
float sample_level(int v, int level) {
  Level l = views[v].levels[level];
  vec2 base_at_level = position.xy * l.scale.x - 0.5;
  vec2 base_whole = floor(base_at_level);
  vec2 p = position.zw * l.scale.x + (base_at_level - base_whole);
  vec2 whole = floor(p);
  vec2 weight = p - whole;
  vec2 pixel = clamp(whole + base_whole, vec2(-1), l.place.zw);
  vec4 four = textureGather(atlas, vec3((l.place.xy + pixel + 1) * vec2(texel_width, texel_height), views[v].radial.w));
  vec2 rows = mix(four.wx, four.zy, weight.x);
  return mix(rows.x, rows.y, weight.y) * l.scale.y + l.scale.z;
}

#define SAMPLE_LEVEL(v, l) luminance[(v) * LEVELS + (l)] = sample_level(v, l);
void sample_view(int v) {
  Place place = places[place_number + v];
  position = place.depth > 0 ? position_by_differences(v, place, from_middle) : vec4(NOT_SHOWN, 0, 0, 0);
  if (place.depth < 0) position = exact[v];
#if HORIZONS
  if (position.x > NOT_SHOWN && !(height_m >= lowest_visible[v * horizon_cells + horizon_cell])) {
    position.x = NOT_SHOWN;
    ++hidden;
  }
#endif
  shown[v] = position.x > NOT_SHOWN ? 1 : 0;
  cost[v] = 0;
  n += shown[v];
  if (!(position.x > NOT_SHOWN)) position = vec4(0);
  ALL_LEVELS(SAMPLE_LEVEL, v)
}

#define LEVEL_DIFFERENCE(i, l) sum += abs(luminance[(i) * LEVELS + (l)] - luminance[k * LEVELS + (l)]);
float difference(int i, int k) {
  float sum = 0;
  ALL_LEVELS(LEVEL_DIFFERENCE, i)
  return sum;
}

void add_difference(int i, int k) {
  float both = difference(i, k) * (shown[i] * shown[k]);
  cost[i] += both;
  cost[k] += both;
}

void add_cost(int k) { mean += cost[k]; }

void hide_unseen(int k) { cost[k] = shown[k] > 0 ? cost[k] : NO_COST; }

void weigh(int k) {
  float weight = clamp(1 - (cost[k] - limit) * per_reach, 0, 1) * shown[k];
  cost[k] = weight;
  weights += weight;
  squares += weight * weight;
}

void add_weighted(int i, int k) { mean += difference(i, k) * (cost[i] * cost[k]); }

float next, equal;
void find_next(int k) { next = cost[k] > limit ? min(next, cost[k]) : next; }
void count_equal(int k) { equal += cost[k] == next ? 1 : 0; }

// The `used` lowest costs: their sum into `mean`, the highest of them into `limit`.
void add_lowest() {
  float taken = 0;
  limit = -1;
  while (taken < used) {  // from one value to the next higher; equal ones count as often as they are there
    next = NO_COST;
    equal = 0;
    ALL_VIEWS(find_next)
    ALL_VIEWS(count_equal)
    if (equal == 0) break;
    mean += next * min(equal, used - taken);
    taken += equal;
    limit = next;
  }
}

// AC of the cell at a plane, the number `p` of `places`, grey levels; NO_COST with fewer than MIN_VIEWS views, the
// hidden cost if there would be enough that are hidden. Sums run
// over window levels and other views, in units of 65535 / 256 grey levels.
float matching_cost(int p, ivec2 cell, int plane) {
  n = hidden = mean = limit = weights = squares = 0;
#if HORIZONS
  height_m = float(double(plane) * geometry[3]);
  horizon_cell = (horizon_first_row + cell.y) / horizon_times * horizon_width + cell.x / horizon_times;
#endif
  place_number = p * VIEWS;
  from_middle = vec2(gl_LocalInvocationID.xy) + (0.5 - BLOCK / 2);
  for (int v = 0; v < VIEWS; ++v)
    if (places[place_number + v].depth < 0) exact[v] = position_in_double(v, cell, plane);
  ALL_VIEWS(sample_view)
#if HORIZONS
  if (n < MIN_VIEWS && n + hidden >= MIN_VIEWS) return hidden_cost;
#endif
  if (n < MIN_VIEWS) return NO_COST;
  ALL_PAIRS(add_difference)
  const float unit = 65535.0 / (256.0 * LEVELS);
#if AGGREGATION == 0
  ALL_VIEWS(add_cost)
  mean /= n * (n - 1);
#elif AGGREGATION == 1
  ALL_VIEWS(hide_unseen)
  used = max(1, floor(0.5 * n));
  add_lowest();
  mean /= used * (n - 1);
#else
  ALL_VIEWS(hide_unseen)
  used = max(ceil(consensus_share * n - SHARE_SLACK), min(n, float(SMALLEST_CONSENSUS)));
  add_lowest();
  mean = 0;
  per_reach = 1 / (CONSENSUS_SOFTNESS * limit + CONSENSUS_SOFTNESS_GREY / unit * (n - 1));
  ALL_VIEWS(weigh)
  ALL_PAIRS(add_weighted)
  mean /= 0.5 * (weights * weights - squares);
#endif
  return mean * unit + few_views_penalty / n;
}
