// SPDX-License-Identifier: Apache-2.0
#include "raster/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <exception>

#include "core/check.h"
#include "core/error.h"
#include "raster/atomic_file.h"

namespace skysweep::raster {

namespace fs = std::filesystem;

void write_exr(const fs::path& path, const ExrImage& image) {
  SKY_CHECK(!image.channels.empty());
  const Array2d<float>& first = image.channels.begin()->second;
  SKY_CHECK(!first.empty());
  Imf::Header header(first.width(), first.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, text] : image.labels) header.insert(key, Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (const auto& [name, values] : image.channels) {
    SKY_CHECK_EQ(values.width(), first.width());
    SKY_CHECK_EQ(values.height(), first.height());
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    auto* data = reinterpret_cast<char*>(const_cast<float*>(values.data()));  // OpenEXR has one type for both ways
    buffer.insert(name, Imf::Slice(Imf::FLOAT, data, sizeof(float), sizeof(float) * values.width()));
  }
  write_atomically(path, [&](const fs::path& temporary) {
    try {
      Imf::OutputFile file(temporary.c_str(), header);
      file.setFrameBuffer(buffer);
      file.writePixels(first.height());
    } catch (const std::exception& error) {
      throw failure(path.string() + " cannot be written: " + error.what());
    }
  });
}

ExrImage read_exr(const fs::path& path) {
  try {
    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    ExrImage image;
    Imf::FrameBuffer buffer;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      Array2d<float>& values = image.channels[channel.name()] = Array2d<float>(width, height);
      // OpenEXR counts from pixel (0, 0), wherever the data begin.
      char* origin =
          reinterpret_cast<char*>(values.data() - window.min.x - static_cast<std::ptrdiff_t>(window.min.y) * width);
      buffer.insert(channel.name(), Imf::Slice(Imf::FLOAT, origin, sizeof(float), sizeof(float) * width));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
        image.labels[attribute.name()] = text->value();
    return image;
  } catch (const std::exception& error) {
    throw bad_input(path.string() + " is not an OpenEXR image that can be read: " + error.what());
  }
}

}  // namespace skysweep::raster
