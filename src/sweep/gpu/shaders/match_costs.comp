// SPDX-License-Identifier: Apache-2.0
// Costs of up to CHUNK planes of one block into the cost volume; behind the last plane of a range goes the padding.
// Follows costs.glsl.

// Of each item: block number, first plane, planes, slot.
layout(std430, binding = 1) readonly buffer Items { ivec4 items[]; };
// volume_layout.h
layout(std430, binding = 2) readonly buffer Blocks { int blocks[]; };
layout(std430, binding = 3) writeonly buffer Volume { ivec4 costs[]; };
uniform int item_count, blocks_across, width, height;

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  if (group >= item_count) return;
  ivec4 item = items[group];
  ivec2 block = ivec2(item.x % blocks_across, item.x / blocks_across);
  find_places(block, item.y, item.z);
  ivec2 cell = block * BLOCK + ivec2(gl_LocalInvocationID.xy);
  if (cell.x >= width || cell.y >= height) return;
  int at = item.x * BLOCK_INTEGERS;
  int element = blocks[at] + int(gl_LocalInvocationID.y) * blocks[at + 1] +
                int(gl_LocalInvocationID.x) * blocks[at + 2] + item.w;
  for (int four = 0; four < CHUNK / 4; ++four) {
    ivec4 units = ivec4(BEYOND_RANGE);
    for (int i = 0; i < 4; ++i) {
      int p = four * 4 + i;
      if (p < item.z)
        units[i] = int(roundEven(min(matching_cost(p, cell, item.y + p) * COST_SCALE, float(WORST_COST))));
    }
    costs[element / 4 + four] = units;
  }
}
