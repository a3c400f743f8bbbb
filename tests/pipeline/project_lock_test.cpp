// SPDX-License-Identifier: Apache-2.0
#include "pipeline/project_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::pipeline {
namespace {

using testing_support::message_of;
using testing_support::TempFolder;

// Another process that holds the lock until it is killed.
class Holder {
 public:
  explicit Holder(const std::filesystem::path& project) {
    int ready[2];
    if (::pipe(ready) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      const ProjectLock lock(project);
      static_cast<void>(!::write(ready[1], "x", 1));
      for (;;) ::pause();
    }
    char byte = 0;
    static_cast<void>(!::read(ready[0], &byte, 1));
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
};

TEST(ProjectLock, keeps_other_processes_out_and_names_the_one_inside) {
  const TempFolder folder;
  Holder holder(folder / "project");
  const std::string message = message_of<Error>([&] { ProjectLock(folder / "project"); });
  EXPECT_NE(message.find("process " + std::to_string(holder.pid())), std::string::npos) << message;
}

TEST(ProjectLock, goes_with_a_process_that_is_killed) {
  const TempFolder folder;
  Holder holder(folder / "project");
  EXPECT_THROW(ProjectLock(folder / "project"), Error);
  holder.kill();
  EXPECT_NO_THROW(ProjectLock(folder / "project"));
}

TEST(ProjectLock, may_be_taken_several_times_by_one_process_and_is_held_until_the_last_is_gone) {
  const TempFolder folder;
  const auto is_free = [&] {
    const int other = ::open((folder / "project/.lock").c_str(), O_RDWR);
    const bool locked = ::flock(other, LOCK_EX | LOCK_NB) == 0;
    ::close(other);
    return locked;
  };
  {
    const ProjectLock outer(folder / "project");
    { const ProjectLock inner(folder / "project/../project"); }
    EXPECT_FALSE(is_free());
  }
  EXPECT_TRUE(is_free());
}

}  // namespace
}  // namespace skysweep::pipeline
