// SPDX-License-Identifier: Apache-2.0
// The one exception of the program: bad input or a hostile environment. The message is a sentence for the user that
// names the file, tile or image and says what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace skysweep {

// What went wrong, as the exit code of the program tells it.
enum class ErrorKind {
  failed = 1,       // the environment: disk full, no permission, a library refused
  usage = 2,        // a wrong option or configuration value
  bad_input = 3,    // photographs, poses or scenes that cannot be used
  memory_plan = 4,  // the job does not fit into --memory
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

inline Error bad_input(const std::string& message) { return {ErrorKind::bad_input, message}; }
inline Error usage_error(const std::string& message) { return {ErrorKind::usage, message}; }
inline Error failure(const std::string& message) { return {ErrorKind::failed, message}; }

}  // namespace skysweep
