// SPDX-License-Identifier: Apache-2.0
// What the plane sweep is asked: a grid of cells, a stack of height planes, and the photographs that look at them
// (Feldmann 2013).
#pragma once

#include <memory>
#include <vector>

#include "camera/camera.h"
#include "core/array2d.h"
#include "core/vec.h"
#include "sweep/horizons.h"
#include "sweep/image_pyramid.h"
#include "sweep/plane_set.h"
#include "sweep/sweep_options.h"

namespace skysweep::sweep {

// Cells in the tile's own frame (a local origin near the cells, so that coordinates are small); row 0 is the
// northernmost.
struct Grid {
  int width = 0;
  int height = 0;
  double cell_m = 1;
  Vec2d north_west_corner;

  Vec2d cell_center(int column, int row) const {
    return {north_west_corner.x + (column + 0.5) * cell_m, north_west_corner.y - (row + 0.5) * cell_m};
  }
};

struct View {
  const ImagePyramid* image = nullptr;
  camera::Camera camera;  // in the tile's frame
  int base_level =
      0;  // mipmap level whose pixels are about as large as a cell: 0 when a cell is no larger than a pixel
  // The search compares gain * luminance + offset, grey levels (sweep/luminance_gains.h).
  double gain = 1, offset = 0;
};

// Planes are searched block by block: each block of kBlockCells x kBlockCells cells has planes of its own.
constexpr int kBlockCells = 16;

// Which views may take part in the cost of a height: those that a surface found before does not hide.
struct VisibilityLimit {
  std::shared_ptr<const Horizons> horizons;  // null: all that show the place
  int times = 1;                             // cells of the problem along one of the horizons'
  int first_row = 0;                         // of the problem's grid in the horizons', counted in cells of the problem

  bool any() const { return horizons != nullptr; }
  float lowest_visible(int view, int column, int row) const {
    return horizons->lowest_visible(view, column / times, (first_row + row) / times);
  }
};

constexpr int blocks_across(int cells) { return (cells + kBlockCells - 1) / kBlockCells; }

constexpr int kSteepestExpectedRise = 6;  // planes from a cell to the next: more is a step

struct SweepProblem {
  Grid grid;
  int collar_cells = 0;  // along the grid's border: swept for what they hide and steady, and not coloured
  double dz_m = 1;
  // Of each block, (0, 0) the north-west one; blocks without planes leave their cells without height.
  Array2d<PlaneSet> block_planes;
  std::vector<View> views;  // their order decides ties: keep it independent of arrival order
  VisibilityLimit visibility;
  // Where a smooth surface is expected in each cell, in planes: smoothing counts steps from the nearest. NaN: nothing
  // is expected there; empty: nowhere.
  Array2d<float> expected_plane;
  // The place as it looks from above (guide_image.h): steps are cheaper at its edges. Empty: nothing is known.
  Array2d<std::uint8_t> guide;
  SweepOptions options;

  // All blocks search the same planes.
  void search_everywhere(PlaneRange planes);
  const PlaneSet& planes_at(int column, int row) const { return block_planes(column / kBlockCells, row / kBlockCells); }
  PlaneRange all_planes() const;  // from the lowest to the highest of any block

  // How many planes the surface is expected to rise between two cells at most so many columns and rows apart; 0 where
  // nothing is expected of one of them, or a step.
  struct Rise {
    int planes = 0;
    float error = 0;  // the rise expected, which need not be a whole number, minus `planes`
  };
  Rise expected_rise(int from_column, int from_row, int to_column, int to_row, int apart = 1) const;

  // A bug in the caller, not bad input: aborts unless views, options and ranges fit together.
  void check() const;
};

// cells x planes x views x window levels: the samples that searching this problem takes.
double sample_count(const SweepProblem& problem);

}  // namespace skysweep::sweep
