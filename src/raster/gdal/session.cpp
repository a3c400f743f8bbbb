// SPDX-License-Identifier: Apache-2.0
#include "raster/gdal/session.h"

#include <mutex>

namespace skysweep::raster {

namespace {

// GDAL's block cache is shared by all threads and takes 5 % of the machine's memory if it is let; the memory plan needs
// a number that it can rely on.
constexpr GIntBig kBlockCacheBytes = 64 << 20;

void prepare_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALAllRegister();
    GDALSetCacheMax64(kBlockCacheBytes);
  });
}

}  // namespace

GdalSession::GdalSession() {
  prepare_gdal();
  CPLPushErrorHandlerEx(&GdalSession::remember, this);
}

GdalSession::~GdalSession() { CPLPopErrorHandler(); }

void CPL_STDCALL GdalSession::remember(CPLErr severity, CPLErrorNum, const char* message) {
  auto* session = static_cast<GdalSession*>(CPLGetErrorHandlerUserData());
  if (severity >= CE_Failure && session->first_error_.empty()) session->first_error_ = message;
}

}  // namespace skysweep::raster
