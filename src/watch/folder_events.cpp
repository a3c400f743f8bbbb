// SPDX-License-Identifier: Apache-2.0
#include "watch/folder_events.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>

namespace skysweep::watch {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kWatched = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MODIFY | IN_CREATE | IN_DELETE | IN_MOVED_FROM |
                                   IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;

// True when there is something to read from `descriptor` (none: -1).
bool wait_for(int descriptor, double seconds) {
  pollfd waiting{descriptor, POLLIN, 0};
  return ::poll(&waiting, 1, static_cast<int>(seconds * 1000)) > 0;
}

// A hard or symbolic link to a file that is already whole: nobody will close it.
bool is_link(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return false;
  return S_ISLNK(found.st_mode) || (S_ISREG(found.st_mode) && found.st_nlink > 1);
}

class Inotify final : public FolderEvents {
 public:
  explicit Inotify(fs::path folder)
      : folder_(std::move(folder)), descriptor_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    ok_ = descriptor_ >= 0 && watch("") && !folders_.empty();
  }
  ~Inotify() override {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Inotify(const Inotify&) = delete;
  Inotify& operator=(const Inotify&) = delete;

  bool ok() const { return ok_; }
  bool tells() const override { return !lost_folder_; }

  std::vector<FileEvent> wait(double seconds) override {
    std::vector<FileEvent> events;
    if (!wait_for(descriptor_, seconds)) return events;
    alignas(inotify_event) std::array<char, 1 << 16> buffer;
    for (ssize_t size; (size = ::read(descriptor_, buffer.data(), buffer.size())) > 0;)
      for (ssize_t at = 0; at < size;) {
        const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
        take(*event, events);
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      }
    return events;
  }

 private:
  // Watches a subfolder (relative, "" for the folder itself) and all below it; false if the system refuses.
  bool watch(const std::string& name) {
    const fs::path path = name.empty() ? folder_ : folder_ / name;
    const int number = ::inotify_add_watch(descriptor_, path.c_str(), kWatched);
    if (number < 0) return errno == ENOENT || errno == ENOTDIR;  // gone again: nothing to watch
    folders_[number] = name;
    std::error_code error;
    bool all = true;
    for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error)) {
      std::error_code ignored;
      const std::string child = it->path().filename().string();
      if (!child.starts_with(".") && it->is_directory(ignored))
        all = watch(name.empty() ? child : name + "/" + child) && all;
    }
    return all;
  }

  void take(const inotify_event& event, std::vector<FileEvent>& events) {
    using Kind = FileEvent::Kind;
    if ((event.mask & (IN_Q_OVERFLOW | IN_DELETE_SELF | IN_MOVE_SELF | IN_UNMOUNT)) != 0) return events.push_back({});
    const auto folder = folders_.find(event.wd);
    if (folder == folders_.end()) return;
    if ((event.mask & IN_IGNORED) != 0) {
      lost_folder_ = lost_folder_ || folder->second.empty();
      folders_.erase(folder);
      return;
    }
    const std::string file = event.len > 0 ? event.name : "";
    const std::string name = folder->second.empty() ? file : folder->second + "/" + file;
    if ((event.mask & IN_ISDIR) != 0) {
      // What lay in a new folder before it was watched, or went with an old one, no event tells.
      if ((event.mask & (IN_CREATE | IN_MOVED_TO)) != 0 && !file.starts_with(".")) watch(name);
      return events.push_back({});
    }
    if ((event.mask & (IN_DELETE | IN_MOVED_FROM)) != 0) return events.push_back({Kind::gone, name});
    if ((event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0) return events.push_back({Kind::closed, name});
    if ((event.mask & IN_CREATE) != 0 && is_link(folder_ / name)) return events.push_back({Kind::closed, name});
    const bool told = !events.empty() && events.back().kind == Kind::written && events.back().name == name;
    if (!told) events.push_back({Kind::written, name});
  }

  fs::path folder_;
  int descriptor_ = -1;
  bool ok_ = false;
  bool lost_folder_ = false;
  std::map<int, std::string> folders_;
};

class NoEvents final : public FolderEvents {
 public:
  std::vector<FileEvent> wait(double seconds) override {
    wait_for(-1, seconds);
    return {};
  }
  bool tells() const override { return false; }
};

}  // namespace

std::unique_ptr<FolderEvents> folder_events(const fs::path& folder) {
  auto events = std::make_unique<Inotify>(folder);
  if (!events->ok()) return nullptr;
  return events;
}

std::unique_ptr<FolderEvents> no_events() { return std::make_unique<NoEvents>(); }

}  // namespace skysweep::watch
