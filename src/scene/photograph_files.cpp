// SPDX-License-Identifier: Apache-2.0
#include "scene/photograph_files.h"

#include "raster/atomic_file.h"
#include "raster/photo.h"

namespace skysweep::scene {

std::string file_ending(PhotoFormat format) {
  switch (format) {
    case PhotoFormat::png: return "png";
    case PhotoFormat::tiff: return "tif";
    case PhotoFormat::exr: return "exr";
    default: return "jpg";
  }
}

void write_photograph(const std::filesystem::path& path, const Array2d<Rgb8>& photo, int jpeg_quality,
                      const formats::PhotoMetadata* metadata) {
  std::string bytes = raster::encode_image(path, photo, jpeg_quality);
  if (metadata) bytes = formats::with_metadata(bytes, *metadata);
  raster::write_bytes_atomically(path, bytes);
}

}  // namespace skysweep::scene
