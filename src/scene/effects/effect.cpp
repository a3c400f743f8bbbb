// SPDX-License-Identifier: Apache-2.0
#include "scene/effects/effect.h"

#include <array>

namespace skysweep::scene {
namespace {

std::array<std::atomic<long long>, kEffects>& all_calls() {
  static std::array<std::atomic<long long>, kEffects> calls{};
  return calls;
}

}  // namespace

const char* to_string(Stage stage) {
  switch (stage) {
    case Stage::metadata: return "metadata";
    case Stage::rays: return "rays";
    case Stage::light: return "light";
    case Stage::surface: return "surface";
    case Stage::air: return "air";
    case Stage::image: return "image";
    case Stage::sensor: return "sensor";
  }
  return "";
}

long long calls_since_start(EffectId id) { return all_calls()[static_cast<std::size_t>(id)]; }

void Meter::add(long long calls, std::chrono::steady_clock::duration time) const {
  calls_ += calls;
  nanoseconds_ += std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
  all_calls()[static_cast<std::size_t>(id_)] += calls;
}

Stopwatch::~Stopwatch() {
  const auto time = std::chrono::steady_clock::now() - begin_;
  if (sum_) *sum_ += time;
  if (meter_) meter_->add(calls_, time);
}

}  // namespace skysweep::scene
