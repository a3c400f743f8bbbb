// SPDX-License-Identifier: Apache-2.0
// Casts many rays at once, on whatever there is.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/executor.h"
#include "render/ray_caster.h"

namespace skysweep::render {

class Tracer {
 public:
  virtual ~Tracer() = default;
  // hits[i] is that of rays[i]; equal rays give equal bits.
  virtual std::vector<Hit> first_hits(const std::vector<Ray>& rays, const TraceOptions& options) = 0;
  // Squares and elements looked at so far.
  virtual std::int64_t steps() const = 0;
};

// The scalar reference, in parallel. Both arguments must outlive it.
std::unique_ptr<Tracer> make_cpu_tracer(const RayCaster& caster, Executor& executor);

}  // namespace skysweep::render
