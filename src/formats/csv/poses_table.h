// SPDX-License-Identifier: Apache-2.0
// Poses out of a table that is already read, wherever its cells came from.
#pragma once

#include "formats/pose_set.h"
#include "formats/text/csv_table.h"

namespace skysweep::formats {

// Columns as docs/input-formats.md describes them; a cameras.csv is looked for beside `table.path`. Throws
// Error(bad_input), as the PoseCollector does when no image can be used.
PoseSet poses_of_table(const CsvTable& table);

}  // namespace skysweep::formats
