// SPDX-License-Identifier: Apache-2.0
#include "raster/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <stdexcept>
#include <thread>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

namespace fs = std::filesystem;
using namespace testing_support;

TEST(AtomicFile, appears_whole_in_a_folder_made_for_it) {
  const TempFolder folder;
  write_bytes_atomically(folder / "a/b/file.txt", "hello");
  EXPECT_EQ(file_bytes(folder / "a/b/file.txt"), "hello");
  EXPECT_EQ(names_in(folder / "a/b").size(), 1u);
}

TEST(AtomicFile, keeps_the_old_file_when_writing_fails_half_way) {
  const TempFolder folder;
  write_bytes_atomically(folder / "file.txt", "old");
  EXPECT_THROW(write_atomically(folder / "file.txt",
                                [](const fs::path& path) {
                                  put_bytes(path, "half of the ne");
                                  throw std::logic_error("power cut");
                                }),
               std::logic_error);
  EXPECT_EQ(file_bytes(folder / "file.txt"), "old");
  EXPECT_EQ(names_in(folder.path()).size(), 1u) << "the temporary file was left behind";
}

TEST(AtomicFile, is_not_seen_before_it_is_complete) {
  const TempFolder folder;
  write_atomically(folder / "file.txt", [&](const fs::path& path) {
    put_bytes(path, "new");
    EXPECT_FALSE(fs::exists(folder / "file.txt"));
    EXPECT_EQ(path.parent_path(), folder.path());
    EXPECT_EQ(path.extension(), ".txt");
    EXPECT_TRUE(path.filename().string().starts_with("."));
  });
  EXPECT_EQ(file_bytes(folder / "file.txt"), "new");
}

TEST(AtomicFile, is_one_of_the_two_when_two_threads_write_it) {
  const TempFolder folder;
  const std::string a(200'000, 'a'), b(200'000, 'b');
  const auto write_often = [&](const std::string& bytes) {
    for (int i = 0; i < 20; ++i) write_bytes_atomically(folder / "file", bytes);
  };
  std::thread other([&] { write_often(a); });
  write_often(b);
  other.join();
  const std::string result = file_bytes(folder / "file");
  EXPECT_TRUE(result == a || result == b);
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
}

TEST(AtomicFile, names_the_file_and_the_reason_when_the_folder_is_a_file) {
  const TempFolder folder;
  put_bytes(folder / "blocker", "");
  const std::string message = message_of<Error>([&] { write_bytes_atomically(folder / "blocker/file.txt", "x"); });
  EXPECT_NE(message.find("blocker/file.txt"), std::string::npos) << message;
}

TEST(AtomicFile, says_what_stopped_it_when_the_disk_takes_no_more) {
  const TempFolder folder;
  write_bytes_atomically(folder / "file", "old");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_bytes_atomically(folder / "file", std::string(100'000, 'x'));
    } catch (const Error& error) {
      const std::string message = error.what();
      ::_exit(error.kind() == ErrorKind::failed && message.find((folder / "file").string()) != std::string::npos ? 0
                                                                                                                 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(file_bytes(folder / "file"), "old");
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
}

TEST(AtomicFile, leftovers_of_a_crash_are_removed_and_nothing_else) {
  const TempFolder folder;
  write_bytes_atomically(folder / "tiles/y4.tif", "tile");
  put_bytes(folder / "tiles/.hidden", "somebody's");
  const pid_t child = ::fork();
  if (child == 0)
    write_atomically(folder / "tiles/y4.tif", [](const fs::path& path) {
      put_bytes(path, "torn");
      ::_exit(0);
    });
  ::waitpid(child, nullptr, 0);
  ASSERT_EQ(names_in(folder / "tiles").size(), 3u);
  remove_temporary_files(folder.path());
  EXPECT_EQ(names_in(folder / "tiles").size(), 2u);
  EXPECT_EQ(file_bytes(folder / "tiles/y4.tif"), "tile");
  EXPECT_NO_THROW(remove_temporary_files(folder / "missing"));
}

TEST(DiskSpace, of_a_path_that_does_not_exist_yet_is_that_of_its_parent) {
  const TempFolder folder;
  EXPECT_GT(free_disk_space(folder / "not/yet/there"), 0u);
}

TEST(RequireWritableFolder, makes_the_folder_and_leaves_nothing_in_it) {
  const TempFolder folder;
  require_writable_folder(folder / "project");
  EXPECT_TRUE(fs::is_directory(folder / "project"));
  EXPECT_TRUE(fs::is_empty(folder / "project"));
}

TEST(RequireWritableFolder, refuses_what_cannot_be_written) {
  EXPECT_THROW(require_writable_folder("/proc/skysweep"), Error);
  const TempFolder folder;
  put_bytes(folder / "file", "");
  EXPECT_THROW(require_writable_folder(folder / "file"), Error);
}

}  // namespace
}  // namespace skysweep::raster
