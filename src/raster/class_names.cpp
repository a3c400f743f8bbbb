// SPDX-License-Identifier: Apache-2.0
#include "raster/class_names.h"

#include <sstream>

#include "core/error.h"
#include "raster/gdal/session.h"

namespace skysweep::raster {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

std::vector<std::string> read_class_names(const std::filesystem::path& path) {
  GdalSession gdal;
  const DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (!dataset || dataset->GetRasterCount() == 0)
    throw bad_input(path.string() + " is not a raster that can be read: " + gdal.reason("GDAL knows no format for it"));
  std::vector<std::string> names;
  if (char** categories = dataset->GetRasterBand(1)->GetCategoryNames()) {
    for (; *categories; ++categories) names.emplace_back(*categories);
  } else if (const char* list = dataset->GetMetadataItem("CLASS_NAMES")) {
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) names.push_back(trimmed(word));
  }
  return names;
}

}  // namespace skysweep::raster
