// SPDX-License-Identifier: Apache-2.0
#include "sweep/gpu/volume_layout.h"

#include <algorithm>
#include <limits>

#include "gpu/device.h"

namespace skysweep::sweep::on_gpu {
namespace {

static_assert(kVolumeLanes % kPlanesPerItem == 0);

void add_range(int block, const StoredRange& range, VolumeLayout& layout) {
  const int count = range.planes.count(), padded = padded_planes(range.planes);
  layout.ranges.push_back({range.planes.first, count, range.slot});
  for (int i = 0; i < padded; ++i) layout.slot_planes.push_back(i < count ? range.planes.first + i : kNoPlane);
  for (int i = 0; i < padded; i += kPlanesPerItem)
    layout.items.push_back({block, range.planes.first + i, std::clamp(count - i, 0, kPlanesPerItem), range.slot + i});
}

}  // namespace

VolumeLayout::VolumeLayout(const SweepProblem& problem) {
  const Array2d<PlaneSet>& block_planes = problem.block_planes;
  if (CostVolume::bytes_for(problem) / sizeof(Cost) > std::numeric_limits<int>::max())
    throw skysweep::gpu::DeviceError(skysweep::gpu::Trouble::out_of_memory,
                                     "The cost volume has more elements than GPU programs count.");
  for (int by = 0; by < block_planes.height(); ++by) {
    const int first_block = by * block_planes.width();
    std::size_t in_row = 0;
    for (int bx = 0; bx < block_planes.width(); ++bx) {
      const PlaneSet& planes = block_planes(bx, by);
      BlockLayout block;
      block.first_element = static_cast<int>(elements + in_row);
      block.cell_elements = CostVolume::padded_planes(planes);
      block.first_slot_plane = static_cast<int>(slot_planes.size());
      block.first_range = static_cast<int>(ranges.size());
      block.ranges = static_cast<int>(planes.ranges().size());
      const int first_item = static_cast<int>(items.size());
      for_each_stored_range(planes, [&](StoredRange range) { add_range(first_block + bx, range, *this); });
      items_of_blocks.push_back({first_item, static_cast<int>(items.size())});
      blocks.push_back(block);
      in_row +=
          static_cast<std::size_t>(std::min(kBlockCells, problem.grid.width - bx * kBlockCells)) * block.cell_elements;
    }
    for (int bx = 0; bx < block_planes.width(); ++bx) blocks[first_block + bx].row_elements = static_cast<int>(in_row);
    elements += in_row * std::min(kBlockCells, problem.grid.height - by * kBlockCells);
  }
}

}  // namespace skysweep::sweep::on_gpu
