// SPDX-License-Identifier: Apache-2.0
#include "app/commands/evaluate/options.h"

#include <filesystem>

#include "app/option_values.h"
#include "core/error.h"

namespace skysweep::app {

void EvaluateOptions::check() const {
  if (truth.has_value() == points.has_value())
    throw usage_error("Give either --truth (a surface) or --points (check points).");
  if (mask && !truth) throw usage_error("--mask goes with --truth.");
  if (classes && !truth) throw usage_error("--classes goes with --truth.");
  if (difference && !truth) throw usage_error("--difference goes with --truth: points make no map.");
  if (edge_step && !truth) throw usage_error("--edge-step goes with --truth: points have no edges.");
  if (outlier_gsd && !sigma) throw usage_error("--outlier-gsd goes with --sigma.");
  if (ortho.has_value() != truth_ortho.has_value()) throw usage_error("--ortho and --truth-ortho go together.");
  if (!points && (origin || min_track || max_error))
    throw usage_error("--origin, --min-track and --max-error go with --points.");
  require_positive(gsd, "--gsd");
  if (edge_step) require_positive(*edge_step, "--edge-step");
  if (outlier_gsd) require_positive(*outlier_gsd, "--outlier-gsd");
  if (difference_limit) require_positive(*difference_limit, "--difference-limit");
  if (difference && std::filesystem::path(*difference).extension() != ".png")
    throw usage_error("--difference writes a PNG: let its name end in .png, not '" + *difference + "'.");
}

}  // namespace skysweep::app
