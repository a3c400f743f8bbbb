// SPDX-License-Identifier: Apache-2.0
// Checks for bugs: a condition that only a mistake in this program can break. A failed check prints both values and
// aborts. Bad input is not a bug: throw skysweep::Error (core/error.h) for that.
#pragma once

#include <sstream>
#include <string>

namespace skysweep::detail {

[[noreturn]] void check_failed(const char* file, int line, const char* expression, const std::string& values);

template <typename A, typename B>
std::string describe_pair(const A& a, const B& b) {
  std::ostringstream out;
  out << "left = " << a << ", right = " << b;
  return out.str();
}

}  // namespace skysweep::detail

#define SKY_CHECK(condition)                                                                \
  do {                                                                                      \
    if (!(condition)) ::skysweep::detail::check_failed(__FILE__, __LINE__, #condition, ""); \
  } while (false)

#define SKY_CHECK_OP_(a, op, b)                                                                      \
  do {                                                                                               \
    const auto& sky_check_a = (a);                                                                   \
    const auto& sky_check_b = (b);                                                                   \
    if (!(sky_check_a op sky_check_b))                                                               \
      ::skysweep::detail::check_failed(__FILE__, __LINE__, #a " " #op " " #b,                        \
                                       ::skysweep::detail::describe_pair(sky_check_a, sky_check_b)); \
  } while (false)

#define SKY_CHECK_EQ(a, b) SKY_CHECK_OP_(a, ==, b)
#define SKY_CHECK_LT(a, b) SKY_CHECK_OP_(a, <, b)
#define SKY_CHECK_LE(a, b) SKY_CHECK_OP_(a, <=, b)
#define SKY_CHECK_GT(a, b) SKY_CHECK_OP_(a, >, b)
#define SKY_CHECK_GE(a, b) SKY_CHECK_OP_(a, >=, b)
