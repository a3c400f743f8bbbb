// SPDX-License-Identifier: Apache-2.0
// What the system tells of a folder while it happens.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace skysweep::watch {

struct FileEvent {
  enum class Kind {
    written,  // somebody has changed the file and may go on
    closed,   // it was closed after writing, renamed in, or linked
    gone,     // removed or renamed away
    lost,     // more happened than was told: look at the whole folder; no name
  };
  Kind kind = Kind::lost;
  std::string name;  // relative to the folder, with '/' between
};

class FolderEvents {
 public:
  virtual ~FolderEvents() = default;
  // Waits up to `seconds` for something to happen, less when a signal comes in, and gives back what did.
  virtual std::vector<FileEvent> wait(double seconds) = 0;
  // False where only looks at the folder can tell, or when the folder itself has gone (open anew when it is back).
  virtual bool tells() const = 0;
};

// Events of the folder and everything below it (inotify), new subfolders included; they queue in the kernel while
// nobody asks (fs.inotify.max_queued_events paths; beyond that `lost`). Null if the system gives none: too many
// watches, or no inotify. A network file system gives none of what other machines do, and nobody can tell: poll there.
std::unique_ptr<FolderEvents> folder_events(const std::filesystem::path& folder);

// Only waits.
std::unique_ptr<FolderEvents> no_events();

}  // namespace skysweep::watch
