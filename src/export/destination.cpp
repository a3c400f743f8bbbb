// SPDX-License-Identifier: Apache-2.0
#include "export/destination.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "core/error.h"

namespace skysweep::exports {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMark = ".skysweep-part";

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::string scratch_prefix(const fs::path& path) { return "." + path.filename().string() + kMark; }

// "out/" and "out" are one place.
fs::path without_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

void require_free(const fs::path& path, DestinationKind kind, bool overwrite) {
  if (path.empty() || path.filename() == "." || path.filename() == "..")
    throw usage_error("-o takes the name of a file or folder to make, not '" + path.string() + "'.");
  if (!fs::exists(fs::symlink_status(path))) return;
  if (!overwrite) throw usage_error(path.string() + " exists: give another name, or --overwrite to replace it.");
  const bool is_folder = fs::is_directory(path);
  if (kind == DestinationKind::file && is_folder)
    throw usage_error(path.string() + " is a folder, but this format is one file: give the name of a file.");
  if (kind == DestinationKind::folder && !is_folder)
    throw usage_error(path.string() + " is a file, but this format is a folder: give the name of a folder.");
  if (kind == DestinationKind::folder && !fs::is_empty(path) && !fs::exists(path / kLabelsFile))
    throw usage_error(path.string() + " holds other things than an export (there is no " + kLabelsFile +
                      " in it) and is not replaced: give another name.");
}

// Of exports to the same place whose process is gone.
void remove_stale(const fs::path& path) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(path), error)) {
    const std::string name = entry.path().filename().string(), prefix = scratch_prefix(path);
    if (!name.starts_with(prefix)) continue;
    const pid_t process = static_cast<pid_t>(std::strtol(name.c_str() + prefix.size(), nullptr, 10));
    if (process > 0 && process != ::getpid() && ::kill(process, 0) != 0 && errno == ESRCH)
      fs::remove_all(entry.path(), error);
  }
}

void rename_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw failure("cannot write " + to.string() + ": " + error.message());
}

// Swaps two folders in one step where the file system can; otherwise the old one goes out of the way first.
void exchange(const fs::path& made, const fs::path& old) {
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, old.c_str(), RENAME_EXCHANGE) == 0) return;
  const fs::path aside = made.parent_path() / "replaced";
  rename_over(old, aside);
  rename_over(made, old);
}

// Everything written so far to the file system of `folder` is on the disk afterwards: one call for thousands of files.
void flush_file_system(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  const int result = ::syncfs(descriptor);
  const int reason = errno;
  ::close(descriptor);
  if (result != 0) throw failure("cannot write " + folder.string() + ": " + std::generic_category().message(reason));
}

}  // namespace

Destination::Destination(fs::path path, DestinationKind kind, bool overwrite)
    : path_(without_slash(path)), kind_(kind) {
  require_free(path_, kind, overwrite);
  remove_stale(path_);
  scratch_ = folder_of(path_) / (scratch_prefix(path_) + std::to_string(::getpid()));
  std::error_code error;
  fs::create_directories(kind == DestinationKind::folder ? result() : result().parent_path(), error);
  if (error) throw failure("cannot write " + path_.string() + ": " + error.message());
}

Destination::~Destination() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

fs::path Destination::side_file(const std::string& appended) const {
  return scratch_ / "result" / (path_.filename().string() + appended);
}

void Destination::publish() {
  flush_file_system(scratch_);
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch_ / "result"))
    if (entry.path() != result()) rename_over(entry.path(), folder_of(path_) / entry.path().filename());
  if (kind_ == DestinationKind::folder && fs::exists(path_))
    exchange(result(), path_);
  else
    rename_over(result(), path_);
  flush_file_system(folder_of(path_));
}

}  // namespace skysweep::exports
