// SPDX-License-Identifier: Apache-2.0
// How an algorithm runs its independent parts. Algorithms take an Executor; they never make threads. `pipeline`
// implements it with oneTBB, tests and the stand-alone build with the two below.
#pragma once

#include <functional>

namespace skysweep {

class Executor {
 public:
  virtual ~Executor() = default;
  // Calls body(i) once for every i in [0, count), in any order and possibly at the same time, and returns when all are
  // done. An exception from a body reaches the caller. May be nested.
  virtual void parallel_for(int count, const std::function<void(int)>& body) = 0;
};

// One after the other, in order, on the calling thread.
class SerialExecutor final : public Executor {
 public:
  void parallel_for(int count, const std::function<void(int)>& body) override;
};

// A handful of std::threads made for each call: for machines that have nothing but the standard library.
class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(int threads);
  void parallel_for(int count, const std::function<void(int)>& body) override;

 private:
  int threads_;
};

}  // namespace skysweep
