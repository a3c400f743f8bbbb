// SPDX-License-Identifier: Apache-2.0
// The matching cost of a cell at a plane (sweep/view_costs.h), one thread a cell, one work group a block of cells.
//
// Constants: VIEWS, LEVELS (window levels), AGGREGATION (0 all views, 1 better half, 2 consensus), MIN_VIEWS, CHUNK
// (planes that a work group projects at once), BLOCK (cells along a block's side), and those of sweep/gpu/programs.cpp.

layout(local_size_x = BLOCK, local_size_y = BLOCK) in;

// North-west corner x, y, cell, dz; then of each view 22 numbers: cam_from_world by rows, centre, fx, fy, cx, cy, squared
// fold radius, k1, k2, p1, p2, k3.
layout(std430, binding = 0) readonly buffer Geometry { double geometry[]; };
// Of each view: width, height, layer, 1 if it has distortion; then of each window level where it lies in its layer (x, y of
// the pixel (0, 0)), width, height, its number.
layout(std430, binding = 1) readonly buffer Photographs { int photographs[]; };
layout(binding = 0) uniform sampler2DArray atlas;

uniform float texel_width, texel_height;  // of the atlas, which is 1 wide and high
uniform float few_views_penalty;          // grey levels
uniform float consensus_share;

const int VIEW_NUMBERS = 22, VIEW_INTEGERS = 4 + 5 * LEVELS;

// Where a view shows a block at one plane: exactly in its middle, in double precision once for the block; cells follow
// by differences small enough for single precision.
struct Place {
  int state;      // 0 the block is behind the camera, 1 the differences hold, 2 cell by cell in double precision
  ivec2 base;     // whole pixel of the middle
  vec2 remainder; // and what is beyond it
  vec2 normal;    // x / z, y / z of the middle, without distortion
  vec4 slope;     // d x, d y a cell east and a cell south, to be divided by the depth
  vec3 depth;     // of the middle, and its growth a cell east and south
};
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
  Place place;
  dvec3 q = in_camera(view, ground(double(block.x * BLOCK + BLOCK / 2), double(block.y * BLOCK + BLOCK / 2), plane));
  double cell = geometry[2];
  dvec3 east = cell * dvec3(number(view, 0), number(view, 3), number(view, 6));
  dvec3 south = -cell * dvec3(number(view, 1), number(view, 4), number(view, 7));
  double change = double(BLOCK / 2) * (abs(east.z) + abs(south.z));  // of the depth within the block
  place.state = q.z < -change ? 0 : q.z > 4.0lf * change ? 1 : 2;
  place.base = ivec2(0);
  place.remainder = place.normal = vec2(0);
  place.slope = vec4(0);
  place.depth = vec3(1, 0, 0);
  if (place.state != 1) return place;
  dvec2 n = q.xy / q.z;
  dvec2 pixel = pixel_of(view, n);
  // Beyond these the differences are too coarse, or whole numbers too large.
  if (!(max(abs(pixel.x), abs(pixel.y)) < 1e6lf)) {
    place.state = 2;
    return place;
  }
  dvec2 whole = floor(pixel);
  place.base = ivec2(whole);
  place.remainder = vec2(pixel - whole);
  place.normal = vec2(n);
  place.slope = vec4(east.x - n.x * east.z, south.x - n.x * south.z, east.y - n.y * east.z, south.y - n.y * south.z);
  place.depth = vec3(q.z, east.z, south.z);
  return place;
}

// All threads of the group: fills `places` for `count` planes from `first` on.
void find_places(ivec2 block, int first, int count) {
  for (int i = int(gl_LocalInvocationIndex); i < count * VIEWS; i += BLOCK * BLOCK)
    places[i] = place_of(i % VIEWS, block, first + i / VIEWS);
  barrier();
}

// The change of a position in the photograph, in pixels, where the normalised one changes from n by d: only
// differences of polynomials, so that nothing is lost to cancellation.
vec2 distorted_change(int view, vec2 n, vec2 d) {
  float k1 = float(number(view, 17)), k2 = float(number(view, 18)), k3 = float(number(view, 21));
  float p1 = float(number(view, 19)), p2 = float(number(view, 20));
  float r0 = dot(n, n), e = dot(2 * n + d, d), r2 = r0 + e;
  float radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  float radial_change = e * (k1 + k2 * (r2 + r0) + k3 * (r2 * r2 + r2 * r0 + r0 * r0));
  float xy2 = 2 * (n.x * d.y + n.y * d.x + d.x * d.y);
  vec2 squares = d * (2 * n + d);  // change of x^2, y^2
  return d * radial + n * radial_change +
         vec2(p1 * xy2 + p2 * (e + 2 * squares.x), p2 * xy2 + p1 * (e + 2 * squares.y));
}

// Whether the view shows the cell, and where: whole pixel and the rest.
bool position(int view, Place place, ivec2 cell, int plane, out ivec2 base, out vec2 rest) {
  vec2 size = vec2(photographs[view * VIEW_INTEGERS], photographs[view * VIEW_INTEGERS + 1]);
  base = place.base;
  rest = vec2(0);
  if (place.state == 0) return false;
  if (place.state == 2) {
    dvec3 q = in_camera(view, ground(double(cell.x) + 0.5lf, double(cell.y) + 0.5lf, plane));
    if (!(q.z > 0.0lf)) return false;
    dvec2 n = q.xy / q.z;
    if (!(dot(n, n) < number(view, 16))) return false;
    dvec2 pixel = pixel_of(view, n);
    if (!(pixel.x >= 0.0lf && pixel.y >= 0.0lf && pixel.x <= double(size.x) && pixel.y <= double(size.y))) return false;
    base = ivec2(floor(pixel));
    rest = vec2(pixel - dvec2(base));
    return true;
  }
  vec2 from_middle = vec2(gl_LocalInvocationID.xy) + (0.5 - BLOCK / 2);
  float depth = place.depth.x + dot(place.depth.yz, from_middle);
  vec2 d = vec2(dot(place.slope.xy, from_middle), dot(place.slope.zw, from_middle)) / depth;
  vec2 n = place.normal + d;
  if (photographs[view * VIEW_INTEGERS + 3] != 0) {
    if (!(dot(n, n) < float(number(view, 16)))) return false;
    d = distorted_change(view, place.normal, d);
  }
  rest = place.remainder + vec2(float(number(view, 12)), float(number(view, 13))) * d;
  vec2 least = vec2(-base), most = size - vec2(base);
  return rest.x >= least.x && rest.y >= least.y && rest.x <= most.x && rest.y <= most.y;
}

// Bilinear luminance, 0 to 1, with weights of full precision: the four pixels come in one gather, addressed by the
// corner that they share.
float sample_level(int view, int level, ivec2 base, vec2 rest) {
  int at = view * VIEW_INTEGERS + 4 + level * 5;
  ivec2 origin = ivec2(photographs[at], photographs[at + 1]);
  ivec2 size = ivec2(photographs[at + 2], photographs[at + 3]);
  float scale = exp2(float(-photographs[at + 4]));
  vec2 base_at_level = vec2(base) * scale - 0.5;
  vec2 base_whole = floor(base_at_level);
  vec2 p = rest * scale + (base_at_level - base_whole);
  vec2 whole = floor(p);
  vec2 weight = p - whole;
  ivec2 pixel = clamp(ivec2(whole) + ivec2(base_whole), ivec2(-1), size - 1);
  vec4 four = textureGather(atlas, vec3(vec2(origin + pixel + 1) * vec2(texel_width, texel_height), photographs[view * VIEW_INTEGERS + 2]));
  vec2 rows = mix(four.wx, four.zy, weight.x);
  return mix(rows.x, rows.y, weight.y);
}

// AC of the cell at plane number `p` of `places`, grey levels; NO_COST with fewer than MIN_VIEWS views. Sums run over
// window levels and other views, in units of 65535 / 256 grey levels.
float matching_cost(int p, ivec2 cell, int plane) {
  float luminance[VIEWS * LEVELS];
  float shown[VIEWS];
  float cost[VIEWS];
  float n = 0;
  for (int v = 0; v < VIEWS; ++v) {
    ivec2 base;
    vec2 rest;
    bool is_shown = position(v, places[p * VIEWS + v], cell, plane, base, rest);
    shown[v] = is_shown ? 1 : 0;
    cost[v] = 0;
    n += shown[v];
    for (int l = 0; l < LEVELS; ++l) luminance[v * LEVELS + l] = is_shown ? sample_level(v, l, base, rest) : 0;
  }
  if (n < MIN_VIEWS) return NO_COST;
  for (int i = 0; i + 1 < VIEWS; ++i) {
    for (int k = i + 1; k < VIEWS; ++k) {
      float sum = 0;
      for (int l = 0; l < LEVELS; ++l) sum += abs(luminance[i * LEVELS + l] - luminance[k * LEVELS + l]);
      sum *= shown[i] * shown[k];
      cost[i] += sum;
      cost[k] += sum;
    }
  }
  const float unit = 65535.0 / (256.0 * LEVELS);
  float mean = 0;
#if AGGREGATION == 0
  for (int k = 0; k < VIEWS; ++k) mean += cost[k];
  mean /= n * (n - 1);
#else
  for (int k = 0; k < VIEWS; ++k) cost[k] = shown[k] > 0 ? cost[k] : NO_COST;
#if AGGREGATION == 1
  float used = max(1, floor(0.5 * n));
#else
  float used = max(ceil(consensus_share * n - SHARE_SLACK), min(n, float(SMALLEST_CONSENSUS)));
#endif
  float limit = 0;
  for (int k = 0; k < VIEWS; ++k) {
    float rank = 0;
    for (int j = 0; j < VIEWS; ++j) rank += (cost[j] < cost[k] || (cost[j] == cost[k] && j < k)) ? 1 : 0;
#if AGGREGATION == 1
    mean += rank < used ? cost[k] : 0;
#else
    limit = rank == used - 1 ? cost[k] : limit;
#endif
  }
#if AGGREGATION == 1
  mean /= used * (n - 1);
#else
  float per_reach = 1 / (CONSENSUS_SOFTNESS * limit + CONSENSUS_SOFTNESS_GREY / unit * (n - 1));
  float weights = 0, squares = 0;
  for (int k = 0; k < VIEWS; ++k) {
    float weight = clamp(1 - (cost[k] - limit) * per_reach, 0, 1) * shown[k];
    cost[k] = weight;
    weights += weight;
    squares += weight * weight;
  }
  for (int i = 0; i + 1 < VIEWS; ++i) {
    float of_first = 0;
    for (int k = i + 1; k < VIEWS; ++k) {
      float sum = 0;
      for (int l = 0; l < LEVELS; ++l) sum += abs(luminance[i * LEVELS + l] - luminance[k * LEVELS + l]);
      of_first += sum * cost[k];
    }
    mean += of_first * cost[i];
  }
  mean /= 0.5 * (weights * weights - squares);
#endif
#endif
  return mean * unit + few_views_penalty / n;
}
