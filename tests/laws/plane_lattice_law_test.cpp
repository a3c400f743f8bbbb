// SPDX-License-Identifier: Apache-2.0
// Law: planes lie on the absolute lattice z = k dz. A wider height range, wherever it begins, moves no plane, so that a
// height whose plane wins in both ranges is the same to the bit.
#include <cmath>
#include <vector>

#include "laws/small_flight.h"
#include "pipeline/coverage.h"
#include "pipeline/tile_job.h"

namespace skysweep::laws {
namespace {

class PlaneLatticeLaw : public SmallFlight {};

TEST_F(PlaneLatticeLaw, a_wider_height_range_moves_no_height_that_wins_in_both) {
  // Every cell by itself, searched everywhere: with smoothing, or from coarse to fine, a neighbour that finds another
  // plane may change a cell, too; and gaps are filled from their surroundings.
  write_tile_settings("[sweep]\nsmoothing = \"none\"\ncoarse_levels = 0\nfill = false\n");
  pipeline::RunRequest r = request("project");
  r.dry_run = true;
  const pipeline::RunSummary summary = run(r);
  const double dz = summary.settings.lattice.dz_m;
  const pipeline::Coverage coverage(summary.images, summary.settings);
  pipeline::PhotoCache photos(r.images, std::size_t{1} << 28, summary.settings.configuration.sweep.normalization());
  SerialExecutor executor;

  long long in_both = 0, same = 0, moved = 0;
  for (const tiles::TileKey key : coverage.tiles(std::nullopt)) {
    pipeline::PreparedTile tile =
        pipeline::prepare_tile(key, coverage.candidates(key), summary.settings, photos, executor);
    if (!tile.heights) continue;
    tile.problem.search_everywhere(sweep::planes_between(-0.5, 2.5, dz, 0));
    const Array2d<float> narrow = sweep::plane_sweep(tile.problem, sweep::Backend::cpu, executor).height_m;
    // Neither end is a multiple of dz away from those of the narrow range.
    tile.problem.search_everywhere(sweep::planes_between(-0.5 - 7.3 * dz, 2.5 + 12.6 * dz, dz, 0));
    const Array2d<float> wide = sweep::plane_sweep(tile.problem, sweep::Backend::cpu, executor).height_m;
    for (std::size_t i = 0; i < wide.size(); ++i) {
      const float a = narrow.data()[i], b = wide.data()[i];
      if (std::isnan(a) || std::isnan(b)) continue;
      if (b < -0.5 + 2 * dz || b > 2.5 - 2 * dz) continue;  // the narrow range does not reach its neighbouring planes
      ++in_both;
      same += a == b;
      moved += a != b && std::abs(a - b) < dz;  // the same plane, fitted otherwise
    }
  }
  ASSERT_GT(in_both, 10000);
  EXPECT_GE(static_cast<double>(same), 0.99 * static_cast<double>(in_both));
  EXPECT_EQ(moved, 0) << "of " << in_both << ", " << same << " are the same";
}

}  // namespace
}  // namespace skysweep::laws
