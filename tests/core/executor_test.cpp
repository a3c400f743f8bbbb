// SPDX-License-Identifier: Apache-2.0
#include "core/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace skysweep {
namespace {

// What every executor promises, for each of ours.
class AnyExecutor : public testing::TestWithParam<int> {
 protected:
  // 0 stands for the serial one, n > 0 for n threads.
  std::unique_ptr<Executor> executor() const {
    if (GetParam() == 0) return std::make_unique<SerialExecutor>();
    return std::make_unique<ThreadExecutor>(GetParam());
  }
};

TEST_P(AnyExecutor, runs_every_part_exactly_once) {
  for (const int count : {0, 1, 2, 3, 17, 1000}) {
    std::vector<std::atomic<int>> runs(count);
    executor()->parallel_for(count, [&](int i) { ++runs.at(i); });
    for (int i = 0; i < count; ++i) EXPECT_EQ(runs[i], 1) << "part " << i << " of " << count;
  }
}

TEST_P(AnyExecutor, is_done_when_it_returns) {
  std::vector<int> squares(500);
  executor()->parallel_for(500, [&](int i) { squares[i] = i * i; });
  for (int i = 0; i < 500; ++i) EXPECT_EQ(squares[i], i * i);
}

TEST_P(AnyExecutor, passes_an_exception_on_to_the_caller) {
  try {
    executor()->parallel_for(100, [](int i) {
      if (i == 42) throw std::runtime_error("part 42 failed");
    });
    FAIL() << "the exception was swallowed";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "part 42 failed");
  }
}

TEST_P(AnyExecutor, can_be_used_again_after_an_exception) {
  const auto e = executor();
  EXPECT_THROW(e->parallel_for(4, [](int) { throw std::runtime_error("no"); }), std::runtime_error);
  std::atomic<int> sum{0};
  e->parallel_for(4, [&](int i) { sum += i; });
  EXPECT_EQ(sum, 6);
}

TEST_P(AnyExecutor, may_be_nested) {
  const auto e = executor();
  std::atomic<int> sum{0};
  e->parallel_for(5, [&](int i) { e->parallel_for(7, [&](int j) { sum += 10 * i + j; }); });
  EXPECT_EQ(sum, 7 * 10 * (0 + 1 + 2 + 3 + 4) + 5 * (0 + 1 + 2 + 3 + 4 + 5 + 6));
}

INSTANTIATE_TEST_SUITE_P(Threads, AnyExecutor, testing::Values(0, 1, 2, 8));

TEST(SerialExecutor, keeps_the_order) {
  std::vector<int> order, expected(50);
  std::iota(expected.begin(), expected.end(), 0);
  SerialExecutor().parallel_for(50, [&](int i) { order.push_back(i); });
  EXPECT_EQ(order, expected);
}

TEST(ThreadExecutorDeathTest, without_threads_is_a_bug) { EXPECT_DEATH(ThreadExecutor(0), "left = 0, right = 1"); }

}  // namespace
}  // namespace skysweep
