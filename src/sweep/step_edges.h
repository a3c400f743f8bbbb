// SPDX-License-Identifier: Apache-2.0
// Puts the edges of steps where the photographs show them. Windows, smoothing and shadows leave the edge of a roof a
// few cells from its place. Near steps, each cell is asked once more which of the surfaces around it the views see
// there: by the colours at the cell alone, past the surface found so far, and by what its neighbours chose.
#pragma once

#include "core/executor.h"
#include "sweep/edge_evidence.h"
#include "sweep/heights.h"
#include "sweep/sweep_problem.h"

namespace skysweep::sweep {

// Minimises, over the cells within edge_reach_cells (SweepOptions) of a step or a gap,
//   sum over cells of C(z) + edge_penalty sum over pairs of neighbours on different surfaces of w,
// where z is one of the heights that the surfaces up to a cell farther away have in the cell, C(z) the mean difference
// between the colours of the views that see it (a view that the surface hides it from counts edge_hidden_cost), in
// units of what is usual in the tile, and w falls where the colours of the two cells differ, and where their heights
// hardly do. By iterated conditional modes (Besag 1986), edge_passes times, each with the visibility that the one
// before left. Where nearly everything is a step, as in trees, nothing is an edge. Heights that change are those of a
// plane through their surface; other cells stay as they are, bit for bit. A gap whose best surface fewer than min_views
// views see, or see alike, stays one.
EdgeEvidence settle_edges(const SweepProblem& problem, Executor& executor, Heights& heights);

}  // namespace skysweep::sweep
