// SPDX-License-Identifier: Apache-2.0
// The settings of the plane sweep. No tuning number of the sweep stands anywhere else.
#pragma once

#include <optional>
#include <string>

#include "sweep/normalization.h"

namespace skysweep::sweep {

// More views than this cannot serve one tile: their costs are kept side by side on the stack.
inline constexpr int kMaxViews = 32;

enum class MatchingCost {
  sad,     // absolute differences of luminance, mean over the window levels (sweep/view_costs.h)
  zncc,    // 1 - zero-mean normalised cross-correlation of patches of cells (sweep/patch_costs.h)
  census,  // which cells of the patch are brighter than the middle one
};

enum class Aggregation {
  all_views,    // mean over all views that show the sample
  better_half,  // mean over the floor(n/2) views that agree best with all the others
  consensus,    // of the views that agree best, a share of all, only the differences among themselves count: views that
                // are hidden from the place do not raise its cost
};

enum class Smoothing {
  none,         // every cell by itself: the classic sweep
  semi_global,  // along eight paths over the tile's cost volume (sweep/smoothing.h)
};

enum class Orthophoto {
  best,  // each cell from one view: as sharp as the photographs
  mean,  // of the views that agree: less noise, a little less sharp
};

struct SweepOptions {
  // Support windows of 2^min x 2^min to 2^max x 2^max pixels: the matching cost is the sum over these mipmap levels.
  // Larger windows steady the match on weak texture and eat roof edges.
  int window_level_min = 0;
  int window_level_max = 1;

  // How views are compared. Patches need no normalised luminance (normalization_radius_px = 0), and a GPU cannot yet.
  MatchingCost cost = MatchingCost::sad;

  // zncc and census: patches of 2 r + 1 cells a side, 2^w cells apart at window level w. 1 or 2.
  int patch_radius_cells = 2;

  // Luminance is normalised to zero mean and unit deviation (20 grey levels) within so many pixels around each, so that
  // photographs of different exposure and surfaces of different contrast compare; 0: as photographed, the classic cost.
  int normalization_radius_px = 2;

  // Only pixels that differ by at most so many grey levels from the one in the middle count for its normalisation: what
  // lies beyond an edge does not. 0: all count, and the radius may exceed 5.
  int normalization_tolerance = 80;

  // Coarser grids that are searched first, each with cells twice as large as the next: the first everywhere, the others
  // and the fine one only near what it found; 0: everywhere at once (sweep/coarse_to_fine.h).
  int coarse_levels = 2;

  // A coarse height is followed as well if the cost of its minimum is at most so far above the best one's, grey levels.
  double rival_tolerance = 1;

  // On the finest of the coarser grids: how often the search is repeated with the views that see past the surface found
  // so far, where that surface is not sure (sweep/horizons.h).
  int visibility_passes = 1;

  // A height is sure when the next best of its cell costs at least so much more, grey levels.
  double sure_excess = 5;

  // Smoothing follows the slopes that the finest of the coarser grids found where it is sure.
  bool follow_slopes = true;

  // Between neighbouring cells that differ by more grey levels than this, seen from above, P2 falls in proportion, down
  // to a quarter; 0: it is the same everywhere.
  double edge_contrast = 12;

  // What a height costs that fewer than min_views views see past the sure surface, grey levels: neither likely nor
  // ruled out.
  double hidden_cost = 6;

  Aggregation aggregation = Aggregation::consensus;

  // How many of the views that show a place make up its consensus, at least three of them: fewer find what few see,
  // more measure it better.
  double consensus_share = 0.6;

  Smoothing smoothing = Smoothing::semi_global;

  // Prices of height steps between neighbouring cells, grey levels of matching cost: P1 for one plane, P2 for more.
  // Higher ones fill weak texture and swallow thin things.
  double small_step_penalty = 1;
  double large_step_penalty = 12;

  // With smoothing: the height between planes is steadied by the costs of the cells up to this many columns and rows
  // away that lie on the same surface (sweep/sub_plane.h); 0: each cell from its own path sums, which locks heights to
  // the planes.
  int refinement_radius_cells = 4;

  // Most that the cost volume of a tile may take (its sums take as much again): a larger one is swept in bands.
  int volume_limit_mib = 512;

  // A sample that fewer views show has no cost. At least 2.
  int min_views = 2;

  // Added to the cost of a sample, divided by the number of views that show it, grey levels: of few views some agree by
  // chance, and without this a plane that fewer views can show would win for that reason alone.
  double few_views_penalty = 1.5;

  // Mean absolute difference in grey levels above which the best plane is not believed.
  double max_cost = 40;

  // The cost of the best plane must stay below the mean cost by this factor, or nothing distinguishes it: 1 believes
  // everything. The mean is the larger of that over all planes, from the coarsest grid, and that over those left.
  double max_cost_to_mean = 0.95;

  // Uneven patches of heights smaller than this that stand apart from their surroundings are not believed
  // (sweep/speckles.h): more removes more false matches, and small things with them. 0: all are believed.
  int speckle_cells = 0;

  // How often cells near steps are asked again which of the surfaces around them the views see there
  // (sweep/step_edges.h); 0: edges stay where the search put them.
  int edge_passes = 3;

  // So near to a step or a gap, in columns and rows.
  int edge_reach_cells = 2;

  // What a cell pays for lying on a surface that none of its neighbours lies on, in units of the difference of colour
  // that is usual between views of one place of the tile: more makes edges straighter and takes small corners.
  double edge_penalty = 10;

  // What a view counts that the surface hides from the cell, in the same units: neither for nor against.
  double edge_hidden_cost = 2.5;

  // Cells that fewer than min_views views can see past the surface around them get the height of the lower side of
  // that surface, marked as such in the mask; false leaves them empty.
  bool fill = true;

  // With fill: remaining gaps of fewer cells than this are filled, too, although enough views see them and found no
  // height to believe there. 0: they stay empty.
  int close_gap_cells = 128;

  // Parallax of one plane step as a share of a pixel: how dz is derived when it is not given (0.6 loses nothing after
  // sub-plane fitting; finer costs time).
  double plane_step_px = 0.6;

  // What the colour of a cell is made of.
  Orthophoto orthophoto = Orthophoto::best;

  // Price of taking the colours of neighbouring cells from different views, grey levels for each pair of cells, more
  // where the two views look different there: high ones keep seams short and let them go where they do not show; 0:
  // every cell chooses by itself (sweep/view_choice.h).
  double seam_cost = 1;

  // Photographs whose exposure differs are made to agree in the orthophoto; false: colours stay as photographed.
  bool compensate_exposure = true;

  // Colour for cells without height from a horizontal plane at the lowest height searched; marked as such in the mask.
  bool planar_fallback = false;

  Normalization normalization() const { return {normalization_radius_px, normalization_tolerance}; }

  std::optional<std::string> problem() const;
  friend bool operator==(const SweepOptions&, const SweepOptions&) = default;
};

}  // namespace skysweep::sweep
