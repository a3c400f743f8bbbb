// SPDX-License-Identifier: Apache-2.0
// The winner of each cell from its costs and their smoothed sums (sweep/best_planes.h), one thread a cell.

layout(local_size_x = BLOCK, local_size_y = BLOCK) in;
layout(std430, binding = 0) readonly buffer Blocks { int blocks[]; };
layout(std430, binding = 1) readonly buffer SlotPlanes { int slot_planes[]; };
layout(std430, binding = 2) readonly buffer Volume { int costs[]; };
layout(std430, binding = 3) readonly buffer Sums { int sums[]; };
// Of each cell MATCH_INTEGERS numbers, floats by their bits: plane, cost, mean cost, fraction, bend, rival plane, rival
// excess; costs NO_COST and fractions NO_FRACTION where there is none.
layout(std430, binding = 4) writeonly buffer Matches { int matches[]; };
uniform int width, height, blocks_across;

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  ivec2 cell = ivec2(group % blocks_across, group / blocks_across) * BLOCK + ivec2(gl_LocalInvocationID.xy);
  if (cell.x >= width || cell.y >= height) return;
  int at = group * BLOCK_INTEGERS, slots = blocks[at + 2], planes_at = blocks[at + 3];
  int element = blocks[at] + int(gl_LocalInvocationID.y) * blocks[at + 1] + int(gl_LocalInvocationID.x) * slots;
  int best = -1, least = BEYOND_RANGE;
  uint low = 0, high = 0, seen = 0;  // the sum of the costs in two halves, so that it is exact
  for (int slot = 0; slot < slots; ++slot) {
    if (slot_planes[planes_at + slot] == NO_PLANE) continue;
    int cost = costs[element + slot], sum = sums[element + slot];
    if (cost != WORST_COST) {
      low += uint(cost) & 0xFFFFu;
      high += uint(cost) >> 16;
      ++seen;
    }
    if (best < 0 || sum < least) {
      best = slot;
      least = sum;
    }
  }
  int plane = best < 0 ? 0 : slot_planes[planes_at + best];
  float cost = NO_COST, mean = NO_COST, fraction = NO_FRACTION, bend = NO_FRACTION, excess = NO_COST;
  int rival_plane = 0;
  bool known = best >= 0 && seen > 0u && costs[element + best] != WORST_COST;
  if (known) {
    cost = float(costs[element + best]) / COST_SCALE;
    mean = (float(high) * 65536 + float(low)) / float(seen) / COST_SCALE;
    int rival_sum = BEYOND_RANGE;
    bool has_below = false, has_above = false;
    int sum_before = 0, plane_before = NO_PLANE;
    for (int slot = 0; slot < slots; ++slot) {
      int k = slot_planes[planes_at + slot];
      if (k == NO_PLANE) {
        plane_before = NO_PLANE;
        continue;
      }
      int sum = sums[element + slot];
      bool follows = plane_before != NO_PLANE && plane_before == k - 1;
      bool followed = slot + 1 < slots && slot_planes[planes_at + slot + 1] == k + 1;
      if (slot == best) {
        has_below = follows;
        has_above = followed;
      }
      if (sum < rival_sum && abs(k - plane) > RIVAL_DISTANCE && !(follows && sum_before < sum) &&
          !(followed && sums[element + slot + 1] < sum)) {
        rival_sum = sum;
        rival_plane = k;
      }
      sum_before = sum;
      plane_before = k;
    }
    if (rival_sum != BEYOND_RANGE) excess = float(rival_sum - least) / (PATHS * COST_SCALE);
    if (has_below && has_above) {
      int below = sums[element + best - 1], above = sums[element + best + 1];
      int second = (below - least) + (above - least);
      if (second > 0) {
        fraction = 0.5 * float(below - above) / float(second);
        bend = float(second) / (PATHS * COST_SCALE);
      }
    }
  }
  int to = (cell.y * width + cell.x) * MATCH_INTEGERS;
  matches[to] = known ? plane : 0;
  matches[to + 1] = floatBitsToInt(cost);
  matches[to + 2] = floatBitsToInt(mean);
  matches[to + 3] = floatBitsToInt(fraction);
  matches[to + 4] = floatBitsToInt(bend);
  matches[to + 5] = rival_plane;
  matches[to + 6] = floatBitsToInt(excess);
}
