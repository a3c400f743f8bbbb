// SPDX-License-Identifier: Apache-2.0
#include "raster/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.h"

namespace skysweep::raster {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTemporaryMark = ".skysweep-part";

std::string reason(int error_number) { return std::generic_category().message(error_number); }

Error cannot_write(const fs::path& path, const std::string& why) {
  return failure("cannot write " + path.string() + ": " + why);
}

// An open file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool is_open() const { return fd_ >= 0; }
  int get() const { return fd_; }

 private:
  int fd_;
};

// Waits until the disk has the file's bytes, or the folder's list of names. `blamed` is named in the error.
void flush_to_disk(const fs::path& path, const fs::path& blamed) {
  const Descriptor file(path, O_RDONLY);
  // EINVAL: some network and user-space file systems cannot flush a folder; nothing better can be done there.
  if (!file.is_open() || (::fsync(file.get()) != 0 && errno != EINVAL)) throw cannot_write(blamed, reason(errno));
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Like create_directories, but a power cut cannot take the new folders away again.
void make_folders(const fs::path& folder, const fs::path& blamed) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path f = folder; !f.empty() && !fs::exists(f, error); f = f.parent_path()) missing.push_back(f);
  fs::create_directories(folder, error);
  if (error) throw cannot_write(blamed, "the folder " + folder.string() + " cannot be made: " + error.message());
  for (const fs::path& made : missing) flush_to_disk(folder_of(made), blamed);
}

// Unique among the threads and processes of this machine; hidden, so that nobody takes it for a result.
fs::path temporary_path(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  std::ostringstream name;
  name << '.' << path.stem().string() << kTemporaryMark << ::getpid() << '-' << counter++ << path.extension().string();
  return folder_of(path) / name.str();
}

void write_all(const fs::path& path, std::string_view bytes, const fs::path& blamed) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) throw cannot_write(blamed, reason(errno));
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot_write(blamed, reason(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  make_folders(folder_of(path), path);
  const fs::path temporary = temporary_path(path);
  try {
    write(temporary);
    flush_to_disk(temporary, path);
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) throw cannot_write(path, error.message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  flush_to_disk(folder_of(path), path);
}

void write_bytes_atomically(const fs::path& path, std::string_view bytes) {
  write_atomically(path, [&](const fs::path& temporary) { write_all(temporary, bytes, path); });
}

void remove_temporary_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(".") && name.find(kTemporaryMark) != std::string::npos && it->is_regular_file(error))
      found.push_back(it->path());
  }
  for (const fs::path& file : found) fs::remove(file, error);
}

std::uint64_t free_disk_space(const fs::path& path) {
  std::error_code error;
  fs::path existing = fs::absolute(path);
  while (!fs::exists(existing, error) && existing.has_relative_path()) existing = existing.parent_path();
  const fs::space_info space = fs::space(existing, error);
  if (error) throw failure("cannot tell the free space of " + existing.string() + ": " + error.message());
  return space.available;
}

void require_writable_folder(const fs::path& folder) {
  make_folders(folder, folder);
  const fs::path probe = temporary_path(folder / "probe");
  try {
    write_all(probe, "probe", folder);
  } catch (const Error& error) {
    std::error_code ignored;
    fs::remove(probe, ignored);
    throw failure(std::string(error.what()) + "; choose another folder or change its permissions");
  }
  fs::remove(probe);
}

}  // namespace skysweep::raster
