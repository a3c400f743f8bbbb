// SPDX-License-Identifier: Apache-2.0
// The program's executor: oneTBB with a fixed number of threads.
#pragma once

#include <memory>

#include "core/executor.h"

namespace skysweep::pipeline {

class TbbExecutor final : public Executor {
 public:
  // `threads` >= 1, the calling one included.
  explicit TbbExecutor(int threads);
  ~TbbExecutor() override;

  int threads() const { return threads_; }

  // A thread that waits here helps with this loop only, never with other work of the caller's level: what a tile holds
  // in memory is not multiplied by waiting.
  void parallel_for(int count, const std::function<void(int)>& body) override;

  // Calls body(i) for i in [0, count), starting in order, with at most `in_flight` of them at a time.
  void for_each_in_order(int count, int in_flight, const std::function<void(int)>& body);

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace skysweep::pipeline
