// SPDX-License-Identifier: Apache-2.0
// A view laid out for the inner loops: the camera as plain numbers, the window levels as raw pointers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sweep/sweep_problem.h"
#include "sweep/view_costs.h"

namespace skysweep::sweep::cpu {

constexpr int kSegmentCells = kBlockCells;  // cells between two knots of the projection: those of one block
constexpr int kSegmentsPerRun = 3;          // segments that share their knots: with these, eight knots, a vector
constexpr int kRunCells = kSegmentsPerRun * kSegmentCells;
constexpr int kKnotsBefore = 2;              // knots to the left of the first segment
constexpr int kKnots = kSegmentsPerRun + 5;  // and three to the right of the last one's first

struct LevelKernel {
  const std::uint32_t* pairs = nullptr;  // LuminanceLevel::pairs
  int stride = 0;
  int width = 0, height = 0;
  float scale = 1;  // 2^-level
};

struct ViewKernel {
  Mat3d cam_from_world;
  Vec3d center;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  camera::Distortion distortion;
  double fold_radius_squared = 0;
  float width = 0, height = 0;
  float gain = 1, offset = 0;  // of what is sampled, stored units
  std::array<LevelKernel, kMaxWindowLevels> levels;
  const camera::Camera* camera = nullptr;
};

ViewKernel make_view_kernel(const View& view, const SweepOptions& options);

// A run of at most kRunCells cells of one row, with what is known about them so far.
struct RunState {
  alignas(64) std::array<float, kRunCells> best;
  alignas(64) std::array<float, kRunCells> below;
  alignas(64) std::array<float, kRunCells> above;
  alignas(64) std::array<float, kRunCells> previous;  // cost at the plane before
  alignas(64) std::array<float, kRunCells> sum;
  alignas(64) std::array<float, kRunCells> seen;
  alignas(64) std::array<std::int32_t, kRunCells> plane;
};

struct RunJob {
  const std::vector<ViewKernel>* views = nullptr;
  const SweepOptions* options = nullptr;
  Vec2d first_cell;  // centre of the first cell, tile frame
  double cell_m = 1;
  double dz_m = 1;
  int cells = 0;
  std::array<const PlaneSet*, kSegmentsPerRun> planes{};  // of each segment; null beyond the last
  const float* lowest_visible = nullptr;  // of each cell, kRunCells for each view; null: views see everything
};

}  // namespace skysweep::sweep::cpu
