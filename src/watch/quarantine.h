// SPDX-License-Identifier: Apache-2.0
// What cannot be used, with its reason, as a table for people and spreadsheets. The files stay where they are: the
// watched folder may be read-only, and a sender may be about to replace them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace skysweep::watch {

// A table file,reason, sorted by file.
std::string quarantine_text(const std::map<std::string, std::string>& reasons);

// A field of a CSV file (RFC 4180): in double quotes where it holds what would be mistaken for something else.
std::string csv_field(const std::string& text);
// The rows of such a file; fields may hold line breaks.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

}  // namespace skysweep::watch
