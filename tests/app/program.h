// SPDX-License-Identifier: Apache-2.0
// The built program as a child process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skysweep::app_test {

using Arguments = std::vector<std::string>;

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string out;
  std::string err;
};

class Process {
 public:
  // `largest_file_bytes`: writing beyond that size fails, as it would on a full disk.
  explicit Process(const Arguments& arguments, std::optional<std::size_t> largest_file_bytes = std::nullopt);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool is_running();
  void interrupt();  // as Ctrl-C does
  Outcome wait();

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
  std::filesystem::path scratch_;  // a folder for what the process prints
};

// Runs the program to its end.
Outcome skysweep(const Arguments& arguments);

}  // namespace skysweep::app_test
