// SPDX-License-Identifier: Apache-2.0
// Where the values of a cost volume lie, as the compute programs read it: the very layout of CostVolume, so that the
// two are copied as they are; and the work of filling it, cut into items.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sweep/cost_volume.h"

namespace skysweep::sweep::on_gpu {

constexpr int kPlanesPerItem = 8;     // a thread writes the costs of so many planes side by side
constexpr int kNoPlane = -(1 << 30);  // in slot_planes: padding

struct BlockLayout {
  int first_element = 0;  // of its north-west cell
  int row_elements = 0;   // from one row of cells to the next
  int cell_elements = 0;
  int first_slot_plane = 0;  // in slot_planes
  int first_range = 0, ranges = 0;
};
constexpr int kBlockIntegers = sizeof(BlockLayout) / sizeof(int);

struct StoredRangeLayout {
  int first_plane = 0, planes = 0, slot = 0;
};

// Up to kPlanesPerItem slots of a block, from `slot` on; `planes` of them hold planes, the rest is padding.
struct WorkItem {
  int block = 0, first_plane = 0, planes = 0, slot = 0;
};

struct VolumeLayout {
  // Throws gpu::DeviceError(out_of_memory) if the volume has more elements than programs can count.
  explicit VolumeLayout(const SweepProblem& problem);

  std::vector<BlockLayout> blocks;  // row by row
  std::vector<int> slot_planes;
  std::vector<StoredRangeLayout> ranges;
  std::vector<WorkItem> items;                      // block after block, planes ascending
  std::vector<std::array<int, 2>> items_of_blocks;  // the first and the one behind the last
  std::size_t elements = 0;
};

}  // namespace skysweep::sweep::on_gpu
