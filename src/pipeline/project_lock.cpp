// SPDX-License-Identifier: Apache-2.0
#include "pipeline/project_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <system_error>

#include "core/error.h"

namespace skysweep::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLockFile = ".lock";

std::string reason(int error_number) { return std::generic_category().message(error_number); }

// "process 4711 on laptop": for the one who is kept waiting.
std::string own_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on " + host.data();
}

std::string name_of_holder(const fs::path& file) {
  std::ifstream in(file);
  std::string name;
  return std::getline(in, name) ? name : "another process";
}

}  // namespace

struct ProjectLock::Held {
  explicit Held(const fs::path& project) {
    const fs::path file = project / kLockFile;
    descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw failure("cannot write in the project " + project.string() + ": " + reason(errno) +
                    "; choose another folder with -o or change its permissions");
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int why = errno;
      ::close(descriptor);
      if (why == EWOULDBLOCK)
        throw failure("the project " + project.string() + " is being written by " + name_of_holder(file) +
                      ": wait until it has finished, or stop it");
      throw failure("cannot lock the project " + project.string() + ": " + reason(why) +
                    "; its file system may know no locks, choose another with -o");
    }
    sign();
  }
  ~Held() { ::close(descriptor); }  // the file stays: who opens it next locks it again
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  // The name is a courtesy: on a full disk the lock holds without it.
  void sign() const {
    const std::string name = own_name() + "\n";
    if (::ftruncate(descriptor, 0) == 0) static_cast<void>(!::write(descriptor, name.data(), name.size()));
  }

  int descriptor = -1;
};

ProjectLock::ProjectLock(const fs::path& project) {
  static std::mutex mutex;
  static std::map<fs::path, std::weak_ptr<Held>> held_here;
  std::error_code error;
  fs::create_directories(project, error);
  if (error) throw failure("cannot make the project folder " + project.string() + ": " + error.message());
  const fs::path place = fs::weakly_canonical(project, error);
  const std::lock_guard lock(mutex);
  std::weak_ptr<Held>& here = held_here[place];
  held_ = here.lock();
  if (held_) return;
  held_ = std::make_shared<Held>(project);
  here = held_;
}

}  // namespace skysweep::pipeline
