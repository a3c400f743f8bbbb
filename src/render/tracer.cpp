// SPDX-License-Identifier: Apache-2.0
#include "render/tracer.h"

#include <algorithm>
#include <atomic>
#include <utility>

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

class FallbackTracer final : public Tracer {
 public:
  FallbackTracer(std::unique_ptr<Tracer> first, std::unique_ptr<Tracer> second,
                 std::function<void(const std::string&)> tell)
      : first_(std::move(first)), second_(std::move(second)), tell_(std::move(tell)) {}

  std::vector<Hit> first_hits(const std::vector<Ray>& rays, const TraceOptions& options) override {
    if (!failed_) try {
        return first_->first_hits(rays, options);
      } catch (const gpu::DeviceError& error) {
        failed_ = true;
        tell_(error.what());
      }
    return second_->first_hits(rays, options);
  }
  std::int64_t steps() const override { return first_->steps() + second_->steps(); }

 private:
  std::unique_ptr<Tracer> first_, second_;
  std::function<void(const std::string&)> tell_;
  bool failed_ = false;
};

}  // namespace

std::unique_ptr<Tracer> with_fallback(std::unique_ptr<Tracer> first, std::unique_ptr<Tracer> second,
                                      std::function<void(const std::string&)> tell) {
  return std::make_unique<FallbackTracer>(std::move(first), std::move(second), std::move(tell));
}

std::unique_ptr<Tracer> make_cpu_tracer(const RayCaster& caster, Executor& executor) {
  return std::make_unique<CpuTracer>(caster, executor);
}

}  // namespace skysweep::render
