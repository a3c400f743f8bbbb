// SPDX-License-Identifier: Apache-2.0
// Casts many rays at once, on whatever there is.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/executor.h"
#include "gpu/device.h"
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

// The same on a device, in double precision, too: hits equal to those of the reference but for what the rounding of a
// division moves (tests/contract). Both arguments must outlive it. This and the tracing throw gpu::DeviceError, with
// Trouble::out_of_memory if the device cannot hold the field.
std::unique_ptr<Tracer> make_gpu_tracer(const RayCaster& caster, gpu::Device& device);

// `first` as long as its device does what it is asked for; from its first failure on, of which `tell` gets a sentence,
// `second`.
std::unique_ptr<Tracer> with_fallback(std::unique_ptr<Tracer> first, std::unique_ptr<Tracer> second,
                                      std::function<void(const std::string&)> tell);

}  // namespace skysweep::render
