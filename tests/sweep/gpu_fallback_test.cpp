// SPDX-License-Identifier: Apache-2.0
// What the gpu backend does when its device fails, and what it keeps there.
#include <gtest/gtest.h>

#include "gpu/device.h"
#include "sweep/backend.h"
#include "sweep/gpu/engine.h"
#include "sweep/gpu/volume_layout.h"
#include "sweep/synthetic_views.h"

namespace skysweep::sweep {
namespace {

using on_gpu::Engine;

double flat(double, double) { return 0.3; }

test::SyntheticProblem small_problem() {
  test::SyntheticProblem p = test::ring_of_views(3, test::small_camera(150, 160, 120), flat);
  test::set_grid(p.problem, 20, 0.2, 0.2, -1, 1);
  p.problem.options.window_level_max = 1;
  return p;
}

std::shared_ptr<Engine> engine_or_null() {
  try {
    return on_gpu::engine();
  } catch (const gpu::DeviceError&) {
    return nullptr;
  }
}

class GpuFallback : public testing::Test {
 protected:
  void SetUp() override {
    listen_to_gpu_trouble([this](const std::string& sentence) { told.push_back(sentence); });
  }
  void TearDown() override { listen_to_gpu_trouble(nullptr); }

  std::vector<std::string> told;
  SerialExecutor serial;
};

TEST_F(GpuFallback, tile_of_a_lost_device_comes_from_the_cpu_and_the_next_from_a_new_device) {
  const std::shared_ptr<Engine> engine = engine_or_null();
  if (!engine) GTEST_SKIP() << "no context can be made";
  const test::SyntheticProblem p = small_problem();
  const MatchResult by_cpu = match_planes(p.problem, Backend::cpu, serial);
  const MatchResult before = match_planes(p.problem, Backend::gpu, serial);
  EXPECT_TRUE(told.empty()) << told.front();
  engine->device().give_up();
  const MatchResult lost = match_planes(p.problem, Backend::gpu, serial);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("cpu"), std::string::npos) << told[0];
  EXPECT_TRUE(lost.plane == by_cpu.plane && lost.cost == by_cpu.cost);
  const MatchResult after = match_planes(p.problem, Backend::gpu, serial);
  EXPECT_EQ(told.size(), 1u);
  EXPECT_NE(on_gpu::engine(), engine);
  EXPECT_TRUE(after.plane == before.plane && after.cost == before.cost && after.mean_cost == before.mean_cost);
}

TEST_F(GpuFallback, every_thread_gets_the_same_bits) {
  if (!engine_or_null()) GTEST_SKIP() << "no context can be made";
  const test::SyntheticProblem p = small_problem();
  const MatchResult alone = match_planes(p.problem, Backend::gpu, serial);
  std::vector<MatchResult> together(3);
  ThreadExecutor(3).parallel_for(3, [&](int i) { together[i] = match_planes(p.problem, Backend::gpu, serial); });
  for (const MatchResult& result : together) EXPECT_TRUE(result.plane == alone.plane && result.cost == alone.cost);
  EXPECT_TRUE(told.empty());
}

TEST_F(GpuFallback, photographs_are_uploaded_once_and_the_oldest_give_way) {
  const std::shared_ptr<Engine> engine = engine_or_null();
  if (!engine) GTEST_SKIP() << "no context can be made";
  const test::SyntheticProblem p = small_problem();
  const auto& views = p.problem.views;
  on_gpu::PhotographStore store(engine->device(), 1);  // room for one problem's views, whatever they take
  const std::vector<View> first = {views[0], views[1]}, second = {views[1], views[2]};
  const std::vector<int> of_first = store.layers_of(first);
  EXPECT_NE(of_first[0], of_first[1]);
  EXPECT_EQ(store.uploads(), 2);
  store.layers_of(first);
  EXPECT_EQ(store.uploads(), 2);
  EXPECT_EQ(store.layers_of(second)[0], of_first[1]);  // stays
  EXPECT_EQ(store.uploads(), 3);
  store.layers_of({views[0]});
  EXPECT_EQ(store.uploads(), 4);
  const std::size_t of_two = store.bytes();
  store.layers_of(views);
  EXPECT_EQ(store.bytes(), of_two / 2 * 3);
}

TEST(VolumeLayoutOnGpu, is_that_of_the_cost_volume) {
  SweepProblem problem;
  problem.grid = {40, 21, 1, {0, 0}};
  problem.search_everywhere(PlaneRange{-3, 20});
  PlaneSet two = PlaneRange{-9, -9};
  two.include(PlaneRange{4, 37});
  problem.block_planes(1, 0) = two;
  problem.block_planes(2, 1) = {};
  CostVolume volume(problem, 0);
  const on_gpu::VolumeLayout layout(problem);
  EXPECT_EQ(layout.elements * sizeof(Cost), volume.bytes());
  for (int y = 0; y < volume.height(); ++y) {
    for (int x = 0; x < volume.width(); ++x) {
      const on_gpu::BlockLayout& block = layout.blocks[(y / kBlockCells) * 3 + x / kBlockCells];
      EXPECT_EQ(block.first_element + (y % kBlockCells) * block.row_elements + (x % kBlockCells) * block.cell_elements,
                volume.cell(x, y) - volume.cell(0, 0));
    }
  }
  for (const on_gpu::WorkItem& item : layout.items)
    for (int i = 0; i < item.planes; ++i)
      EXPECT_EQ(layout.slot_planes[layout.blocks[item.block].first_slot_plane + item.slot + i], item.first_plane + i);
}

}  // namespace
}  // namespace skysweep::sweep
