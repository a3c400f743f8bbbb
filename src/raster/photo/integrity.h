// SPDX-License-Identifier: Apache-2.0
// Whether the bytes of a photograph are all there. Decoders fill what is missing with grey and go on; a surface made of
// half a photograph is worse than none.
#pragma once

#include <string_view>

namespace skysweep::raster {

// Walks the markers of a JPEG (ITU-T T.81, annex B) until its end-of-image marker; what follows it does not matter.
bool jpeg_is_complete(std::string_view bytes);

// Walks the chunks of a PNG (ISO/IEC 15948, section 5) until its IEND.
bool png_is_complete(std::string_view bytes);

}  // namespace skysweep::raster
