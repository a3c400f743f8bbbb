// SPDX-License-Identifier: Apache-2.0
#include "app/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "raster/temp_folder.h"

namespace skysweep::app_test {
namespace {

namespace fs = std::filesystem;

fs::path new_scratch_folder() {
  static int count = 0;
  const fs::path folder =
      fs::path(testing::TempDir()) / ("app_test_output." + std::to_string(::getpid()) + "." + std::to_string(count++));
  fs::create_directories(folder);
  return folder;
}

// In the child: only calls that are safe between fork and exec.
void redirect(int descriptor, const char* file) {
  const int opened = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::dup2(opened, descriptor);
  ::close(opened);
}

void limit_files_to(std::size_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);  // write() then fails, as on a full disk; the signal would end the program
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

}  // namespace

Process::Process(const Arguments& arguments, std::optional<std::size_t> largest_file_bytes)
    : scratch_(new_scratch_folder()) {
  std::vector<char*> argv;
  std::string program = SKYSWEEP_PROGRAM;
  argv.push_back(program.data());
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::string out = scratch_ / "out", err = scratch_ / "err";
  pid_ = ::fork();
  if (pid_ != 0) return;
  redirect(STDOUT_FILENO, out.c_str());
  redirect(STDERR_FILENO, err.c_str());
  if (largest_file_bytes) limit_files_to(*largest_file_bytes);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

Process::~Process() {
  if (!status_) {
    ::kill(pid_, SIGKILL);
    wait();
  }
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

bool Process::is_running() {
  int status = 0;
  if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  return !status_;
}

void Process::interrupt() {
  if (is_running()) ::kill(pid_, SIGINT);
}

Outcome Process::wait() {
  if (!status_) {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    status_ = status;
  }
  return {WIFEXITED(*status_) ? WEXITSTATUS(*status_) : -1, testing_support::file_bytes(scratch_ / "out"),
          testing_support::file_bytes(scratch_ / "err")};
}

Outcome skysweep(const Arguments& arguments) { return Process(arguments).wait(); }

}  // namespace skysweep::app_test
