// SPDX-License-Identifier: Apache-2.0
#include "sweep/gpu/engine.h"

#include <cstdio>
#include <mutex>

#include "core/check.h"
#include "sweep/gpu/shaders.h"
#include "sweep/gpu/volume_layout.h"
#include "sweep/match_result.h"
#include "sweep/smoothing.h"
#include "sweep/view_costs.h"

namespace skysweep::sweep::on_gpu {
namespace {

using skysweep::gpu::Device;
using skysweep::gpu::DeviceError;
using skysweep::gpu::Trouble;

// A software rasteriser's textures lie in the machine's own memory, beside the photographs they are made of.
constexpr std::size_t kPhotographBytes = std::size_t{1} << 30, kSoftwarePhotographBytes = std::size_t{1} << 28;
constexpr int kLossesBeforeDistrust = 3;

std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9e", value);
  return text;
}

std::vector<std::pair<std::string, std::string>> shared_definitions() {
  return {{"BLOCK", std::to_string(kBlockCells)},
          {"BLOCK_INTEGERS", std::to_string(kBlockIntegers)},
          {"CHUNK", std::to_string(kPlanesPerItem)},
          {"NO_PLANE", "(" + std::to_string(kNoPlane) + ")"},
          {"NO_COST", "1e30"},
          {"NO_FRACTION", "1e30"},
          {"MATCH_INTEGERS", "7"},
          {"COST_SCALE", decimal(kCostScale)},
          {"WORST_COST", std::to_string(kWorstCost)},
          {"BEYOND_RANGE", std::to_string(kBeyondRange)},
          {"PATHS", std::to_string(kSmoothingPaths)},
          {"STEEPEST_RISE", std::to_string(kSteepestExpectedRise)},
          {"RIVAL_DISTANCE", std::to_string(kRivalDistance)},
          {"SHARE_SLACK", decimal(kShareSlack)},
          {"SMALLEST_CONSENSUS", std::to_string(kSmallestConsensus)},
          {"CONSENSUS_SOFTNESS", decimal(kConsensusSoftness)},
          {"CONSENSUS_SOFTNESS_GREY", decimal(kConsensusSoftnessGrey)}};
}

// Never destroyed: at the end of the process drivers may be gone before we are.
struct Process {
  std::mutex mutex;
  std::shared_ptr<Engine> engine;
  int losses = 0;
  std::function<void(const std::string&)> listener;
};
Process& process() {
  static auto* const state = new Process;
  return *state;
}

}  // namespace

Engine::Engine()
    : device_(Device::open()),
      photographs_(*device_, device_->is_software() ? kSoftwarePhotographBytes : kPhotographBytes) {}

skysweep::gpu::Program& Engine::program(const std::vector<std::string>& files,
                                        const std::vector<std::pair<std::string, std::string>>& definitions) {
  std::string key, text;
  for (const std::string& file : files) key += file + " ";
  for (const auto& [name, value] : definitions) key += name + "=" + value + " ";
  if (const auto known = programs_.find(key); known != programs_.end()) return known->second;
  for (const std::string& file : files) {
    const auto content = embedded_file(file);
    SKY_CHECK(content.has_value());
    text += *content;
  }
  auto all = shared_definitions();
  all.insert(all.end(), definitions.begin(), definitions.end());
  return programs_.emplace(key, skysweep::gpu::Program(*device_, files.back(), all, text)).first->second;
}

skysweep::gpu::Buffer& Engine::scratch(Scratch purpose, std::size_t bytes) {
  const auto known = scratch_.find(purpose);
  if (known != scratch_.end() && known->second.bytes() >= bytes) return known->second;
  if (known != scratch_.end()) scratch_.erase(known);  // before the larger one is made: both may not fit
  return scratch_.emplace(purpose, skysweep::gpu::Buffer(*device_, bytes)).first->second;
}

std::shared_ptr<Engine> engine() {
  const std::lock_guard lock(process().mutex);
  if (process().losses >= kLossesBeforeDistrust)
    throw DeviceError(Trouble::unavailable, "The GPU was lost " + std::to_string(process().losses) + " times.");
  if (!process().engine) process().engine = std::make_shared<Engine>();
  return process().engine;
}

void abandon(const std::shared_ptr<Engine>& engine) {
  const std::lock_guard lock(process().mutex);
  if (process().engine != engine) return;  // another tile was there first
  process().engine.reset();
  ++process().losses;
}

void set_gpu_listener(std::function<void(const std::string&)> listener) {
  const std::lock_guard lock(process().mutex);
  process().listener = std::move(listener);
}

void tell_gpu_listener(const std::string& sentence) {
  std::function<void(const std::string&)> listener;
  {
    const std::lock_guard lock(process().mutex);
    listener = process().listener;
  }
  if (listener) listener(sentence);
}

}  // namespace skysweep::sweep::on_gpu
