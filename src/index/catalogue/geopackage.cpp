// SPDX-License-Identifier: Apache-2.0
#include "index/catalogue/geopackage.h"

#include <algorithm>
#include <mutex>

namespace skysweep::index {
namespace {

std::string sql_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += c;
  }
  quoted += '\'';
  return quoted;
}

std::map<std::string, GIntBig> row_ids(GDALDataset& dataset, const char* table, const std::vector<std::string>& names) {
  constexpr std::size_t kNamesPerQuery = 500;
  std::map<std::string, GIntBig> ids;
  for (std::size_t begin = 0; begin < names.size(); begin += kNamesPerQuery) {
    std::string list;
    for (std::size_t i = begin; i < std::min(begin + kNamesPerQuery, names.size()); ++i) {
      if (!list.empty()) list += ',';
      list += sql_text(names[i]);
    }
    for_each_row(dataset, std::string("SELECT fid, name FROM ") + table + " WHERE name IN (" + list + ")",
                 [&](const OGRFeature& row) { ids[row.GetFieldAsString("name")] = row.GetFID(); });
  }
  return ids;
}

}  // namespace

QuietGdal::QuietGdal() {
  static std::once_flag once;
  std::call_once(once, GDALAllRegister);
  CPLPushErrorHandlerEx(&QuietGdal::remember, this);
}

QuietGdal::~QuietGdal() { CPLPopErrorHandler(); }

void CPL_STDCALL QuietGdal::remember(CPLErr severity, CPLErrorNum, const char* message) {
  auto* self = static_cast<QuietGdal*>(CPLGetErrorHandlerUserData());
  if (severity >= CE_Failure && self->first_failure_.empty()) self->first_failure_ = message;
}

void for_each_row(GDALDataset& dataset, const std::string& sql, const std::function<void(const OGRFeature&)>& read) {
  OGRLayer* rows = dataset.ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (!rows) return;
  try {
    for (const OGRFeatureUniquePtr& row : *rows) read(*row);
  } catch (...) {
    dataset.ReleaseResultSet(rows);
    throw;
  }
  dataset.ReleaseResultSet(rows);
}

void put_rows(GDALDataset& dataset, const char* table, const std::vector<std::string>& names,
              const std::function<void(std::size_t, OGRFeature&)>& fill) {
  OGRLayer& layer = *dataset.GetLayerByName(table);
  std::map<std::string, GIntBig> ids = row_ids(dataset, table, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer.GetLayerDefn()));
    // Null, not merely unset: replacing a row leaves unset columns as they were.
    for (int field = 0; field < row->GetFieldCount(); ++field) row->SetFieldNull(field);
    row->SetField("name", names[i].c_str());
    fill(i, *row);
    const auto known = ids.find(names[i]);
    OGRErr result;
    if (known != ids.end()) {
      row->SetFID(known->second);
      result = layer.SetFeature(row.get());
    } else {
      result = layer.CreateFeature(row.get());
      ids[names[i]] = row->GetFID();
    }
    if (result != OGRERR_NONE) return;
  }
}

void remove_rows(GDALDataset& dataset, const char* table, const std::vector<std::string>& names) {
  OGRLayer& layer = *dataset.GetLayerByName(table);
  for (const auto& [name, id] : row_ids(dataset, table, names))
    if (layer.DeleteFeature(id) != OGRERR_NONE) return;
}

}  // namespace skysweep::index
