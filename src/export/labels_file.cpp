// SPDX-License-Identifier: Apache-2.0
#include "export/labels_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "raster/crs.h"

namespace skysweep::exports {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw failure("cannot write " + path.string() + ": the disk is full or not writable");
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* no_data_words(raster::CogKind kind) {
  switch (kind) {
    case raster::CogKind::colors: return "alpha 0";
    case raster::CogKind::classes: return "0";
    default: return "NaN";
  }
}

}  // namespace

std::map<std::string, std::string> label_words(const MapRaster& map) {
  std::map<std::string, std::string> words = {{"CONTENT", map.labels.content},
                                              {"CRS", raster::crs_name(map.crs_wkt)},
                                              {"NO_DATA", no_data_words(map.whole.kind())},
                                              {"SOFTWARE", map.labels.software},
                                              {"INPUT_DIGEST", map.labels.input_digest}};
  if (!map.labels.units.empty()) words["UNITS"] = map.labels.units;
  if (!map.labels.vertical_reference.empty()) words["VERTICAL_REFERENCE"] = map.labels.vertical_reference;
  return words;
}

void write_labels_json(const MapRaster& map, const std::map<std::string, std::string>& more,
                       const std::filesystem::path& path) {
  nlohmann::json labels = label_words(map);
  labels.update(nlohmann::json(more));
  labels["CRS_WKT"] = map.crs_wkt;
  write_text(path, labels.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_side_files(const MapRaster& map, const std::string& no_data, const Destination& to) {
  std::map<std::string, std::string> words = label_words(map);
  words["NO_DATA"] = no_data;
  std::string xml = "<PAMDataset>\n  <SRS>" + escaped(map.crs_wkt) + "</SRS>\n  <Metadata>\n";
  for (const auto& [name, text] : words) xml += "    <MDI key=\"" + name + "\">" + escaped(text) + "</MDI>\n";
  write_text(to.side_file(".aux.xml"), xml + "  </Metadata>\n</PAMDataset>\n");
  if (raster::is_local_crs(map.crs_wkt)) return;
  const std::filesystem::path prj = std::filesystem::path(to.result()).replace_extension(".prj");
  write_text(prj, raster::esri_wkt(map.crs_wkt));
}

}  // namespace skysweep::exports
