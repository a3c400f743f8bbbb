// SPDX-License-Identifier: Apache-2.0
#include "core/executor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/check.h"

namespace skysweep {

void SerialExecutor::parallel_for(int count, const std::function<void(int)>& body) {
  for (int i = 0; i < count; ++i) body(i);
}

ThreadExecutor::ThreadExecutor(int threads) : threads_(threads) { SKY_CHECK_GE(threads, 1); }

void ThreadExecutor::parallel_for(int count, const std::function<void(int)>& body) {
  std::atomic<int> next{0};
  std::exception_ptr first_error;
  std::mutex error_mutex;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(error_mutex);
        if (!first_error) first_error = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> helpers;
  for (int t = 1; t < std::min(threads_, count); ++t) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace skysweep
