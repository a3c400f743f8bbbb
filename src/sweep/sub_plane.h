// SPDX-License-Identifier: Apache-2.0
// Heights between planes, from the costs of a cell and of those around it that lie on the same surface.
#pragma once

#include "core/executor.h"
#include "sweep/cost_volume.h"
#include "sweep/match_result.h"

namespace skysweep::sweep {

// Vertex of a cost curve known at three planes one apart, the middle one being the least, relative to the middle: the
// mean of the vertices of a parabola and of a symmetric V through them. Mean absolute differences near their minimum
// lie between the two (a V, rounded by noise and by views of different baselines): the parabola alone is drawn towards
// the planes, the V away from them. NaN where the three do not bend upwards; in [-0.5, 0.5] where the middle is least.
double sub_plane_vertex(double below, double middle, double above);

// Replaces `fraction` of the cells that have one: the costs at the best plane k and its two neighbours are added up
// over the cells within refinement_radius_cells columns and rows whose own best plane is at most 3 from k, both
// counted from the plane expected there (SweepProblem::expected_plane). Path sums, which chose the plane, are drawn
// towards it by the price of steps; plain costs are not, and 3 planes either way keep what lies beyond an edge out. A
// radius of 0 changes nothing.
void refine_fractions(const SweepProblem& problem, const CostVolume& costs, Executor& executor, MatchResult& result);

}  // namespace skysweep::sweep
