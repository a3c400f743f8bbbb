// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tbb_executor.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "core/check.h"

namespace skysweep::pipeline {

struct TbbExecutor::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

TbbExecutor::TbbExecutor(int threads) : threads_(threads) {
  SKY_CHECK_GE(threads, 1);
  arena_ = std::make_unique<Arena>(threads);
}

TbbExecutor::~TbbExecutor() = default;

void TbbExecutor::parallel_for(int count, const std::function<void(int)>& body) {
  arena_->arena.execute([&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, count, body); }); });
}

void TbbExecutor::for_each_in_order(int count, int in_flight, const std::function<void(int)>& body) {
  arena_->arena.execute([&] {
    int next = 0;
    tbb::parallel_pipeline(
        in_flight, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
                     if (next == count) control.stop();
                     return next++;
                   }) & tbb::make_filter<int, void>(tbb::filter_mode::parallel, [&](int i) {
                     if (i < count) body(i);
                   }));
  });
}

}  // namespace skysweep::pipeline
