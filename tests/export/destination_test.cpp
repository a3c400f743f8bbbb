// SPDX-License-Identifier: Apache-2.0
#include "export/destination.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::exports {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

TEST(Destination, nothing_has_the_final_name_until_it_is_published) {
  const TempFolder folder;
  {
    Destination to(folder / "map.asc", DestinationKind::file, false);
    put_bytes(to.result(), "cells");
    put_bytes(to.side_file(".aux.xml"), "labels");
    put_bytes(to.scratch() / "on_the_way", "");
    EXPECT_FALSE(fs::exists(folder / "map.asc"));
    to.publish();
  }
  EXPECT_EQ(file_bytes(folder / "map.asc"), "cells");
  EXPECT_EQ(file_bytes(folder / "map.asc.aux.xml"), "labels");
  EXPECT_EQ(names_in(folder.path()).size(), 2u);
}

TEST(Destination, what_is_not_published_leaves_nothing) {
  const TempFolder folder;
  {
    Destination to(folder / "tiles", DestinationKind::folder, false);
    put_bytes(to.result() / "a.tif", "cells");
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(Destination, an_existing_file_is_replaced_only_when_asked) {
  const TempFolder folder;
  put_bytes(folder / "map.tif", "old");
  const std::string message = message_of<Error>([&] { Destination(folder / "map.tif", DestinationKind::file, false); });
  EXPECT_NE(message.find("--overwrite"), std::string::npos) << message;
  Destination to(folder / "map.tif", DestinationKind::file, true);
  put_bytes(to.result(), "new");
  EXPECT_EQ(file_bytes(folder / "map.tif"), "old");
  to.publish();
  EXPECT_EQ(file_bytes(folder / "map.tif"), "new");
}

// Somebody who names their home folder must not lose it.
TEST(Destination, only_folders_made_by_an_export_are_replaced) {
  const TempFolder folder;
  put_bytes(folder / "home/letter", "dear");
  const std::string message = message_of<Error>([&] { Destination(folder / "home", DestinationKind::folder, true); });
  EXPECT_NE(message.find("other things than an export"), std::string::npos) << message;
  put_bytes(folder / "tiles" / kLabelsFile, "{}");
  put_bytes(folder / "tiles/old.tif", "old");
  {
    Destination to(folder / "tiles/", DestinationKind::folder, true);
    put_bytes(to.result() / kLabelsFile, "{}");
    put_bytes(to.result() / "new.tif", "new");
    to.publish();
  }
  EXPECT_TRUE(fs::exists(folder / "tiles/new.tif"));
  EXPECT_FALSE(fs::exists(folder / "tiles/old.tif"));
  EXPECT_EQ(names_in(folder.path()).size(), 2u);
}

TEST(Destination, files_and_folders_do_not_replace_each_other) {
  const TempFolder folder;
  put_bytes(folder / "file", "");
  fs::create_directory(folder / "folder");
  EXPECT_THROW(Destination(folder / "file", DestinationKind::folder, true), Error);
  EXPECT_THROW(Destination(folder / "folder", DestinationKind::file, true), Error);
  for (const char* wrong : {"", ".", ".."})
    EXPECT_THROW(Destination(wrong, DestinationKind::file, true), Error) << wrong;
  EXPECT_THROW(Destination(folder / "file" / "x", DestinationKind::file, true), Error);
}

TEST(Destination, what_a_killed_export_left_is_removed_by_the_next_one) {
  const TempFolder folder;
  const pid_t killed = ::fork();
  if (killed == 0) {
    Destination to(folder / "tiles", DestinationKind::folder, false);
    put_bytes(to.result() / "half.tif", "half");
    ::_exit(0);  // no destructor runs
  }
  int status = 0;
  ::waitpid(killed, &status, 0);
  EXPECT_FALSE(fs::exists(folder / "tiles"));
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
  { const Destination to(folder / "tiles", DestinationKind::folder, false); }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

}  // namespace
}  // namespace skysweep::exports
