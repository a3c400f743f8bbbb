// SPDX-License-Identifier: Apache-2.0
// Photographs of a synthetic scene, with exact poses and exact truth, ray traced by Embree.
//
//   images/0001.jpg ...   photographs, sRGB
//   poses.csv, sparse/    their poses, and as a COLMAP text model
//   truth/poses.csv       the right poses, if an effect spoils those above
//   truth/dsm.tif         height of the highest surface at the centre of each cell
//   truth/ortho.tif       its colour, averaged over the cell: as in the photographs without noise and gain
//   truth/views.tif       how many photographs see it
//   scene.json            all parameters, resolved
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/executor.h"
#include "scene/scene.h"

namespace skysweep::scene {

struct SimulationOptions {
  std::string software = "skysweep";  // label of the rasters
  // Called after each photograph and after the truth, from the calling thread; may be empty.
  std::function<void(int done, int total)> progress;
};

struct Simulation {
  int photographs = 0;
  double gsd_m = 0;  // at mean ground height
  double truth_cell_m = 0;
  int rays_per_pixel = 4;
  std::vector<EffectReport> effects;  // all there are, in the order in which they act; empty if the build has none
};

// Writes the files above into `folder`, replacing those there. The same scene gives the same bytes, whatever the
// executor; another origin changes no photograph. Throws Error: unusable scene, folder not writable.
Simulation simulate(const Scene& scene, const std::filesystem::path& folder, Executor& executor,
                    const SimulationOptions& options = {});

}  // namespace skysweep::scene
