// SPDX-License-Identifier: Apache-2.0
#include "raster/class_names.h"

#include <sstream>

#include "core/error.h"
#include "raster/gdal/labels.h"
#include "raster/gdal/session.h"

namespace skysweep::raster {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Names of "surface class: 1 ground, 2 roof"; empty for labels that do not list codes in that way.
std::vector<std::string> names_in_label(const std::string& label) {
  const std::size_t colon = label.find("class: ");
  if (colon == std::string::npos) return {};
  std::vector<std::string> names;
  std::istringstream entries(label.substr(colon + 7));
  for (std::string entry; std::getline(entries, entry, ',');) {
    std::istringstream words(entry);
    int code = -1;
    std::string name;
    if (!(words >> code) || code < 0 || code > 255 || !std::getline(words, name) || trimmed(name).empty()) return {};
    if (names.size() <= static_cast<std::size_t>(code)) names.resize(static_cast<std::size_t>(code) + 1);
    names[static_cast<std::size_t>(code)] = trimmed(name);
  }
  return names;
}

}  // namespace

std::vector<std::string> read_class_names(const std::filesystem::path& path) {
  GdalSession gdal;
  const DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (!dataset || dataset->GetRasterCount() == 0)
    throw bad_input(path.string() + " is not a raster that can be read: " + gdal.reason("GDAL knows no format for it"));
  std::vector<std::string> names;
  // Asked for first: GDAL 3.6 reads the .aux.xml of a GeoTIFF for its metadata, but not for its category names.
  const char* list = dataset->GetMetadataItem("CLASS_NAMES");
  if (char** categories = dataset->GetRasterBand(1)->GetCategoryNames()) {
    for (; *categories; ++categories) names.emplace_back(*categories);
  } else if (list) {
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) names.push_back(trimmed(word));
  } else {
    names = names_in_label(labels_of(*dataset).content);
  }
  return names;
}

}  // namespace skysweep::raster
