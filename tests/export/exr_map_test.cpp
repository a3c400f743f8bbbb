// SPDX-License-Identifier: Apache-2.0
// Structure by OpenEXR's own programs, values through its reader of single tiles.
#include "export/exr_map.h"

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfTiledInputPart.h>
#include <half.h>

#include "export/sample_map.h"

namespace skysweep::exports {
namespace {

namespace fs = std::filesystem;

class ExrMap : public SampleMap {
 protected:
  fs::path exr(const MapRequest& request, const std::string& name) {
    Destination to(folder / name, DestinationKind::file, false);
    parts = map_parts(store, request, to.scratch());
    write_exr_map(*parts, to);
    to.publish();
    return folder / name;
  }

  // All cells of a channel of a part.
  template <typename T>
  static Array2d<T> channel(const fs::path& path, int part, const std::string& name, Imf::PixelType type) {
    Imf::MultiPartInputFile file(path.c_str());
    Imf::TiledInputPart in(file, part);
    const Imath::Box2i window = in.header().dataWindow();
    Array2d<T> cells(window.max.x + 1, window.max.y + 1);
    Imf::FrameBuffer buffer;
    buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(cells.data()), sizeof(T), sizeof(T) * cells.width()));
    in.setFrameBuffer(buffer);
    in.readTiles(0, in.numXTiles() - 1, 0, in.numYTiles() - 1);
    return cells;
  }

  std::optional<MapParts> parts;
};

int differences(const Array2d<float>& a, const Array2d<float>& b) {
  EXPECT_EQ(a.width(), b.width());
  EXPECT_EQ(a.height(), b.height());
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    count += !(a.data()[i] == b.data()[i] || (std::isnan(a.data()[i]) && std::isnan(b.data()[i])));
  return count;
}

int srgb(float linear) {
  return static_cast<int>(
      std::lround(255 * (linear <= 0.0031308f ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
}

TEST_F(ExrMap, parts_hold_the_maps_values) {
  // Several tiles of 256 cells; resampled, and the map's own cells.
  for (const MapRequest& request : {MapRequest{}, MapRequest{.cell = 0.15}}) {
    const fs::path file = exr(request, request.cell ? "fine.exr" : "own.exr");
    const auto all = [](const MapRaster& map) { return map.window_of(map.cells); };
    EXPECT_EQ(
        differences(channel<float>(file, 0, "height", Imf::FLOAT), parts->height.whole.floats(all(parts->height))), 0);
    EXPECT_EQ(differences(channel<float>(file, 1, "sigma", Imf::FLOAT), parts->sigma.whole.floats(all(parts->sigma))),
              0);
    const Array2d<std::uint8_t> codes = parts->mask.whole.classes(all(parts->mask));
    const Array2d<unsigned> mask = channel<unsigned>(file, 3, "mask", Imf::UINT);
    EXPECT_TRUE(std::equal(codes.begin(), codes.end(), mask.begin(), mask.end()));
    const Array2d<Rgba8> colors = parts->colour.whole.colors(all(parts->colour));
    const Array2d<half> g = channel<half>(file, 2, "G", Imf::HALF), a = channel<half>(file, 2, "A", Imf::HALF);
    int wrong = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const Rgba8 c = colors.data()[i];
      wrong += std::lround(255 * static_cast<float>(a.data()[i])) != c.a;
      if (c.a == 255) wrong += srgb(g.data()[i]) != c.g;
    }
    EXPECT_EQ(wrong, 0);
  }
}

TEST_F(ExrMap, is_labelled_and_whole_for_openexrs_programs) {
  const fs::path file = exr({}, "map.exr");
  if (run("which exrheader").status != 0) GTEST_SKIP() << "exrheader (package openexr) is not installed";
  const std::string header = run("exrheader " + file.string()).output;
  for (const char* word :
       {"\"height\"", "\"sigma\"", "\"colour\"", "\"mask\"", "tiledimage", "256 by 256",
        "VERTICAL_REFERENCE (type string): \"EGM96 height\"", "UNITS (type string): \"metre\"",
        "NO_DATA (type string): \"NaN\"", "SOFTWARE (type string): \"skysweep test\"", "INPUT_DIGEST", "UTM zone 32N",
        "west (type double): 691200", "colour (linear light", "cell (type double): 0.5"})
    EXPECT_NE(header.find(word), std::string::npos) << word << " is not in\n" << header;
  const ProgramResult check = run("exrinfo -v " + file.string());
  EXPECT_EQ(check.status, 0) << check.output;
}

TEST_F(ExrMap, the_same_map_gives_the_same_bytes) {
  EXPECT_EQ(testing_support::file_bytes(exr({.cell = 0.7}, "a.exr")),
            testing_support::file_bytes(exr({.cell = 0.7}, "b.exr")));
}

TEST_F(ExrMap, stopping_leaves_nothing) {
  {
    Destination to(folder / "map.exr", DestinationKind::file, false);
    EXPECT_THROW(write_exr_map(map_parts(store, {}, to.scratch()), to, [](double) { return false; }), raster::Stopped);
  }
  EXPECT_FALSE(fs::exists(folder / "map.exr"));
}

}  // namespace
}  // namespace skysweep::exports
