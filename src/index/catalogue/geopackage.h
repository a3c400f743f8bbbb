// SPDX-License-Identifier: Apache-2.0
// A GeoPackage through OGR: quiet errors, transactions, and rows that are known by a name.
#pragma once

#include <cpl_error.h>
#include <ogrsf_frmts.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace skysweep::index {

// For as long as one lives, GDAL prints nothing on this thread; its first failure is remembered.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  const std::string& first_failure() const { return first_failure_; }  // empty: none

 private:
  static void CPL_STDCALL remember(CPLErr severity, CPLErrorNum number, const char* message);
  std::string first_failure_;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

// Rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(GDALDataset& dataset) : dataset_(dataset), open_(dataset.StartTransaction() == OGRERR_NONE) {}
  ~Transaction() {
    if (open_) dataset_.RollbackTransaction();
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit() {
    if (open_) open_ = dataset_.CommitTransaction() != OGRERR_NONE;
  }

 private:
  GDALDataset& dataset_;
  bool open_;
};

// Calls `read` for every row that the query gives. Failures are left to the QuietGdal of the caller.
void for_each_row(GDALDataset& dataset, const std::string& sql, const std::function<void(const OGRFeature&)>& read);

// Adds a row for each name, or replaces the row of that name; `fill(i, row)` sets its other columns, which are null.
void put_rows(GDALDataset& dataset, const char* table, const std::vector<std::string>& names,
              const std::function<void(std::size_t, OGRFeature&)>& fill);

// Rows of these names; a name without a row is no mistake.
void remove_rows(GDALDataset& dataset, const char* table, const std::vector<std::string>& names);

}  // namespace skysweep::index
