// SPDX-License-Identifier: Apache-2.0
// Photographs of a synthetic scene, with exact poses and exact truth, ray traced by Embree.
//
//   images/0001.jpg ...   photographs, sRGB
//   poses.csv, sparse/    their poses, and as a COLMAP text model with points and exact tracks
//   gcp_list.txt          ground control points, if the scene asks for them
//   truth/poses.csv       the right poses, if an effect spoils those above
//   truth/dsm.tif         height of the highest surface at the centre of each cell
//   truth/dtm.tif         height of the bare ground there, or of the water on it
//   truth/ortho.tif       its colour, averaged over the cell: as in the photographs without noise and gain
//   truth/views.tif       how many photographs see it
//   truth/classes.tif     what it is: ground, roof, facade edge, tree, water, thin (docs/formats.md)
//   truth/depth/0001.exr  depth of every pixel, if the scene asks for it
//   scene.json            all parameters, resolved
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/executor.h"
#include "scene/scene.h"

namespace skysweep::scene {

struct SimulationOptions {
  std::string software = "skysweep";  // label of the rasters
  // Called once, when the world stands and before the first photograph: how many there will be, and the bytes that will
  // be held at most beside what the program holds by then; may be empty.
  std::function<void(int photographs, std::uint64_t bytes_to_come)> begin;
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
