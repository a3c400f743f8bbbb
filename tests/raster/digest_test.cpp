// SPDX-License-Identifier: Apache-2.0
#include "raster/digest.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::raster {
namespace {

using testing_support::put_bytes;
using testing_support::TempFolder;

// From the test vectors of XXH3 (seed 0, no input).
TEST(Digest, is_xxh3_with_128_bits) { EXPECT_EQ(digest_of_bytes(""), "99aa06d3014798d86001c324468d497f"); }

TEST(Digest, does_not_depend_on_how_the_bytes_are_cut) {
  const std::string bytes(100'000, 'x');
  Digest pieces;
  for (std::size_t i = 0; i < bytes.size(); i += 777) pieces.add_bytes(std::string_view(bytes).substr(i, 777));
  EXPECT_EQ(pieces.hex(), digest_of_bytes(bytes));
}

TEST(Digest, tells_fields_apart) {
  EXPECT_NE(Digest().add_field("ab").add_field("c").hex(), Digest().add_field("a").add_field("bc").hex());
  EXPECT_NE(Digest().add_field("").hex(), Digest().hex());
}

TEST(Digest, of_a_file_is_that_of_its_bytes) {
  const TempFolder folder;
  const std::string bytes(3'000'001, 'y');
  put_bytes(folder / "file", bytes);
  put_bytes(folder / "none", "");
  EXPECT_EQ(digest_of_file(folder / "file"), digest_of_bytes(bytes));
  EXPECT_EQ(digest_of_file(folder / "none"), digest_of_bytes(""));
  EXPECT_THROW(digest_of_file(folder / "missing"), Error);
  EXPECT_THROW(digest_of_file(folder.path()), Error);
}

}  // namespace
}  // namespace skysweep::raster
