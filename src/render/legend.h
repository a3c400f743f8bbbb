// SPDX-License-Identifier: Apache-2.0
// What the colours of a picture stand for, drawn into its lower left corner.
#pragma once

#include "core/array2d.h"
#include "core/color.h"
#include "render/look.h"

namespace skysweep::render {

// A picture narrower than the legend (about 200 pixels) gets none.
void draw_legend(const Scale& scale, Array2d<Rgb8>& picture);

}  // namespace skysweep::render
