// SPDX-License-Identifier: Apache-2.0
// Heights between planes from the costs of the cells around (sweep/sub_plane.h), one thread a cell.

layout(local_size_x = BLOCK, local_size_y = BLOCK) in;
layout(std430, binding = 0) readonly buffer Blocks { int blocks[]; };
// First plane, planes, slot of each range.
layout(std430, binding = 1) readonly buffer Ranges { int ranges[]; };
layout(std430, binding = 2) readonly buffer Volume { int costs[]; };
layout(std430, binding = 3) buffer Matches { int matches[]; };
#if PRIORS
// Of each cell the plane expected there as a whole number, or NO_PLANE, and not rounded; the guide image; nothing.
layout(std430, binding = 4) readonly buffer Priors { ivec4 priors[]; };
#endif
uniform int width, height, blocks_across, radius;

const int SAME_SURFACE_PLANES = 3;

// Three sums in two halves each, so that they are exact.
struct Triple {
  uvec3 low, high;
  float rise_error;  // of the cells that were added up
  int cells;
};

// SweepProblem::expected_rise: whole planes, and what they leave out.
int expected_rise(ivec2 from, ivec2 to, out float error) {
  error = 0;
#if PRIORS
  ivec4 before = priors[from.y * width + from.x], after = priors[to.y * width + to.x];
  int rise = after.x - before.x;
  if (before.x == NO_PLANE || after.x == NO_PLANE || abs(rise) > STEEPEST_RISE * radius) return 0;
  error = intBitsToFloat(after.y) - intBitsToFloat(before.y) - float(rise);
  return rise;
#else
  return 0;
#endif
}

// Element of the cell's value at plane k; -1 unless k and its neighbours lie in one range.
int element_between_neighbours(ivec2 cell, int k) {
  int at = ((cell.y / BLOCK) * blocks_across + cell.x / BLOCK) * BLOCK_INTEGERS;
  for (int r = blocks[at + 4]; r < blocks[at + 4] + blocks[at + 5]; ++r) {
    int i = k - ranges[3 * r];
    if (i >= 1 && i < ranges[3 * r + 1] - 1)
      return blocks[at] + (cell.y % BLOCK) * blocks[at + 1] + (cell.x % BLOCK) * blocks[at + 2] + ranges[3 * r + 2] + i;
  }
  return -1;
}

Triple costs_around(ivec2 middle, int plane) {
  Triple triple = Triple(uvec3(0), uvec3(0), 0, 0);
  ivec2 first = max(middle - radius, ivec2(0)), last = min(middle + radius, ivec2(width, height) - 1);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      int match = (y * width + x) * MATCH_INTEGERS;
      if (!(intBitsToFloat(matches[match + 1]) < NO_COST)) continue;
      float error;
      int same = plane + expected_rise(middle, ivec2(x, y), error);
      if (abs(matches[match] - same) > SAME_SURFACE_PLANES) continue;
      int at = element_between_neighbours(ivec2(x, y), same);
      if (at < 0) continue;
      ivec3 cost = ivec3(costs[at - 1], costs[at], costs[at + 1]);
      if (cost.x == WORST_COST || cost.z == WORST_COST) continue;
      triple.low += uvec3(cost) & 0xFFFFu;
      triple.high += uvec3(cost) >> 16;
      triple.rise_error += error;
      ++triple.cells;
    }
  }
  return triple;
}

dvec3 sums_of(Triple triple) { return dvec3(triple.high) * 65536.0lf + dvec3(triple.low); }

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  ivec2 cell = ivec2(group % blocks_across, group / blocks_across) * BLOCK + ivec2(gl_LocalInvocationID.xy);
  if (cell.x >= width || cell.y >= height) return;
  int match = (cell.y * width + cell.x) * MATCH_INTEGERS;
  if (intBitsToFloat(matches[match + 3]) == NO_FRACTION) return;
  int plane = matches[match];
  Triple around = costs_around(cell, plane);
  dvec3 sum = sums_of(around);
  int step = sum.x < sum.y ? -1 : sum.z < sum.y ? 1 : 0;
  if (step != 0) {
    around = costs_around(cell, plane + step);
    sum = sums_of(around);
  }
  double bend = sum.x - 2.0lf * sum.y + sum.z, rise = max(sum.x, sum.z) - sum.y;
  if (!(bend > 0.0lf && rise > 0.0lf)) return;
  double lean = 0.5lf * (sum.x - sum.z);
  double vertex = clamp(0.5lf * (lean / bend + lean / rise), -0.5lf, 0.5lf);
  double mean_error = around.cells > 0 ? double(around.rise_error) / double(around.cells) : 0.0lf;
  matches[match + 3] = floatBitsToInt(float(double(step) - mean_error + vertex));
}
