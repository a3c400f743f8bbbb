// SPDX-License-Identifier: Apache-2.0
// The best plane of each cell by itself: one work group a block goes through all its planes. Follows costs.glsl.

layout(std430, binding = 1) readonly buffer Items { ivec4 items[]; };
// Of each block: its first item and the one behind its last.
layout(std430, binding = 2) readonly buffer ItemsOfBlocks { ivec2 items_of_blocks[]; };
// Of each cell: cost at the best plane, below and above it, sum and number of all costs, the plane.
layout(std430, binding = 3) writeonly buffer Winners { float winners[]; };
uniform int block_count, blocks_across, width, height;

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  if (group >= block_count) return;
  ivec2 block = ivec2(group % blocks_across, group / blocks_across);
  ivec2 cell = block * BLOCK + ivec2(gl_LocalInvocationID.xy);
  float best = NO_COST, below = NO_COST, above = NO_COST, previous = NO_COST, sum = 0, seen = 0;
  int best_plane = 0, previous_plane = 0;
  for (int i = items_of_blocks[group].x; i < items_of_blocks[group].y; ++i) {
    ivec4 item = items[i];
    find_places(block, item.y, item.z);
    for (int p = 0; p < item.z; ++p) {
      int k = item.y + p;
      float cost = matching_cost(p, cell, k);
      float before = k == previous_plane + 1 ? previous : NO_COST;
      if (k == best_plane + 1 && best < NO_COST) above = cost;
      if (cost < best) {
        best = cost;
        best_plane = k;
        below = before;
        above = NO_COST;
      }
      if (cost < NO_COST) {
        sum += cost;
        ++seen;
      }
      previous = cost;
      previous_plane = k;
    }
    barrier();  // before the places are overwritten
  }
  if (cell.x >= width || cell.y >= height) return;
  int at = (cell.y * width + cell.x) * 6;
  winners[at] = best;
  winners[at + 1] = below;
  winners[at + 2] = above;
  winners[at + 3] = sum;
  winners[at + 4] = seen;
  winners[at + 5] = intBitsToFloat(best_plane);
}
