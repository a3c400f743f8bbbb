// SPDX-License-Identifier: Apache-2.0
// Two programs never write one project: whoever writes holds its lock. The lock is the kernel's (flock on a file of the
// project) and goes with its process, however that ends; none is ever left behind.
#pragma once

#include <filesystem>
#include <memory>

namespace skysweep::pipeline {

class ProjectLock {
 public:
  // Makes the folder if it is missing. Throws Error(failed), naming the process that holds the lock, when another one
  // does, and when the folder cannot be written. Within one process a project may be locked several times over.
  explicit ProjectLock(const std::filesystem::path& project);

 private:
  struct Held;
  std::shared_ptr<Held> held_;
};

}  // namespace skysweep::pipeline
