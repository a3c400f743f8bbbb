// SPDX-License-Identifier: Apache-2.0
// Semi-global smoothing (sweep/smoothing.h), all eight directions at once: one work group a path, threads side by side
// over the planes of a cell. Whole numbers, so the order in which the paths add up does not matter.
//
// Constants: THREADS, PLANES (room for the planes from the lowest to the highest of all), BLOCK, BLOCK_INTEGERS,
// BEYOND_RANGE, NO_PLANE.

layout(local_size_x = THREADS) in;
layout(std430, binding = 0) readonly buffer Blocks { int blocks[]; };
layout(std430, binding = 1) readonly buffer SlotPlanes { int slot_planes[]; };
layout(std430, binding = 2) readonly buffer Volume { int costs[]; };
layout(std430, binding = 3) buffer Sums { int sums[]; };
#if PRIORS
// Of each cell the plane expected there as a whole number, or NO_PLANE, and not rounded; the guide image; nothing.
layout(std430, binding = 4) readonly buffer Priors { ivec4 priors[]; };
#endif
uniform int width, height, blocks_across, lowest_plane, small_penalty, large_penalty;

// Path costs of the cell in work and of the one before, by plane from the lowest of all on, between margins that
// neighbouring planes and expected rises reach into.
const int MARGIN = STEEPEST_RISE + 1;
shared int path[2][PLANES + 2 * MARGIN];
// Their least, of the cell in work, the one before and the one after in turn.
shared int least[3];

// SweepProblem::expected_rise from the cell before.
int expected_rise(ivec2 before, ivec2 cell) {
#if PRIORS
  int from = priors[before.y * width + before.x].x, to = priors[cell.y * width + cell.x].x;
  if (from == NO_PLANE || to == NO_PLANE || abs(to - from) > STEEPEST_RISE) return 0;
  return to - from;
#else
  return 0;
#endif
}

// Penalties::large.
#if PRIORS
uniform int edge_contrast;
#endif
int large_penalty_between(ivec2 before, ivec2 cell) {
#if PRIORS
  int from = priors[before.y * width + before.x].z, to = priors[cell.y * width + cell.x].z;
  int difference = min(abs(to - from), 4 * edge_contrast);
  if (from == 0 || to == 0 || difference <= edge_contrast) return large_penalty;
  return max(small_penalty, large_penalty / difference * edge_contrast);
#else
  return large_penalty;
#endif
}

// First cell and step of path number `group`: rows both ways, columns both ways, then the four diagonals.
void find_path(int group, out ivec2 cell, out ivec2 by) {
  if (group < 2 * height) {
    bool east = group < height;
    cell = ivec2(east ? 0 : width - 1, group % height);
    by = ivec2(east ? 1 : -1, 0);
    return;
  }
  group -= 2 * height;
  if (group < 2 * width) {
    bool south = group < width;
    cell = ivec2(group % width, south ? 0 : height - 1);
    by = ivec2(0, south ? 1 : -1);
    return;
  }
  group -= 2 * width;
  int diagonals = width + height - 1, direction = group / diagonals, line = group % diagonals;
  by = ivec2(direction % 2 == 0 ? 1 : -1, direction / 2 == 0 ? 1 : -1);
  // Along the row where the path may begin, then down the column.
  int first_row = by.y > 0 ? 0 : height - 1, first_column = by.x > 0 ? 0 : width - 1;
  cell = line < width ? ivec2(line, first_row) : ivec2(first_column, first_row + by.y * (line - width + 1));
}

void main() {
  int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
  if (group >= 2 * height + 2 * width + 4 * (width + height - 1)) return;
  ivec2 cell, by;
  find_path(group, cell, by);
  bool pads = group < height;  // each cell lies on one path to the east: this one writes its padding, too
  int thread = int(gl_LocalInvocationID.x);
  for (int i = thread; i < PLANES + 2 * MARGIN; i += THREADS) path[0][i] = path[1][i] = BEYOND_RANGE;
  if (thread == 0) least[0] = least[1] = least[2] = BEYOND_RANGE;
  barrier();
  bool begun = false;        // the cell before has path costs
  int last_block = -1;       // of the cell before
  int cells_in_block = 0;    // on this path up to here
  for (int step = 0; cell.x >= 0 && cell.x < width && cell.y >= 0 && cell.y < height; ++step, cell += by) {
    int now = step & 1, before = now ^ 1;
    int block = (cell.y / BLOCK) * blocks_across + cell.x / BLOCK;
    cells_in_block = block == last_block ? cells_in_block + 1 : 0;
    last_block = block;
    // The first two cells of a block find the planes of other blocks where they write.
    if (cells_in_block < 2) {
      for (int i = thread; i < PLANES + 2 * MARGIN; i += THREADS) path[now][i] = BEYOND_RANGE;
      barrier();
    }
    int at = block * BLOCK_INTEGERS, slots = blocks[at + 2];
    int element = blocks[at] + (cell.y % BLOCK) * blocks[at + 1] + (cell.x % BLOCK) * slots;
    int least_before = begun ? least[(step + 2) % 3] : 0;
    int least_here = BEYOND_RANGE;
    int rise = begun ? expected_rise(cell - by, cell) : 0;
    int large = begun ? large_penalty_between(cell - by, cell) : 0;
    for (int slot = thread; slot < slots; slot += THREADS) {
      int plane = slot_planes[blocks[at + 3] + slot];
      if (plane == NO_PLANE) {
        if (pads) sums[element + slot] = BEYOND_RANGE;
        continue;
      }
      int k = plane - lowest_plane + MARGIN;
      int value = costs[element + slot];
      if (begun) {
        int same = k - rise;
        int neighbour = min(path[before][same - 1], path[before][same + 1]) + small_penalty;
        value += min(min(path[before][same], neighbour), least_before + large) - least_before;
      }
      path[now][k] = value;
      least_here = min(least_here, value);
      atomicAdd(sums[element + slot], value);
    }
    if (least_here < BEYOND_RANGE) atomicMin(least[step % 3], least_here);
    if (thread == 0) least[(step + 1) % 3] = BEYOND_RANGE;
    barrier();
    begun = slots > 0;
  }
}
