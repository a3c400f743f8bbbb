// SPDX-License-Identifier: Apache-2.0
// The way into GDAL: registers its drivers once, bounds its cache, and for as long as a session lives keeps it from
// printing on this thread and remembers what it complained about.
#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>

#include <memory>
#include <string>

namespace skysweep::raster {

class GdalSession {
 public:
  GdalSession();
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  // The first error since the session began; empty if there was none. GDAL 3.6 reports failed writes only through its
  // error handler when a file is closed, so this is asked after closing.
  const std::string& first_error() const { return first_error_; }
  // For messages: the first error, or `otherwise` if GDAL gave no reason.
  std::string reason(const std::string& otherwise) const { return first_error_.empty() ? otherwise : first_error_; }

 private:
  static void CPL_STDCALL remember(CPLErr severity, CPLErrorNum number, const char* message);
  std::string first_error_;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

}  // namespace skysweep::raster
