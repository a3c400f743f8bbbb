// SPDX-License-Identifier: Apache-2.0
#include "render/tracer.h"

#include <algorithm>
#include <atomic>

namespace skysweep::render {
namespace {

class CpuTracer final : public Tracer {
 public:
  CpuTracer(const RayCaster& caster, Executor& executor) : caster_(caster), executor_(executor) {}

  std::vector<Hit> first_hits(const std::vector<Ray>& rays, const TraceOptions& options) override {
    constexpr std::size_t kRaysAPart = 2048;
    std::vector<Hit> hits(rays.size());
    executor_.parallel_for(static_cast<int>((rays.size() + kRaysAPart - 1) / kRaysAPart), [&](int part) {
      std::int64_t steps = 0;
      const std::size_t begin = static_cast<std::size_t>(part) * kRaysAPart;
      for (std::size_t i = begin; i < std::min(begin + kRaysAPart, rays.size()); ++i)
        hits[i] = caster_.first_hit(rays[i], options, &steps);
      steps_ += steps;
    });
    return hits;
  }
  std::int64_t steps() const override { return steps_; }

 private:
  const RayCaster& caster_;
  Executor& executor_;
  std::atomic<std::int64_t> steps_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> make_cpu_tracer(const RayCaster& caster, Executor& executor) {
  return std::make_unique<CpuTracer>(caster, executor);
}

}  // namespace skysweep::render
