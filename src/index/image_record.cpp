// SPDX-License-Identifier: Apache-2.0
#include "index/image_record.h"

namespace skysweep::index {

const char* to_string(ImageStatus status) {
  switch (status) {
    case ImageStatus::used: return "used";
    case ImageStatus::oblique: return "oblique";
    case ImageStatus::refused: return "refused";
    case ImageStatus::removed: return "removed";
  }
  return "unknown";
}

}  // namespace skysweep::index
