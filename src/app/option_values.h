// SPDX-License-Identifier: Apache-2.0
// Values of command line options that are more than one word or number. All throw Error(usage), naming the option.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "core/vec.h"
#include "sweep/backend.h"
#include "sweep/height_range.h"

namespace skysweep::app {

Vec3d parse_origin(const std::string& text);                            // "X,Y,Z"
Vec3d parse_place(const std::string& text, const std::string& option);  // "E,N,H"
Box2d parse_area(const std::string& text);                              // "x0,y0,x1,y1"
sweep::HeightRange parse_height_range(const std::string& text);         // "a,b"
// Two numbers "a,b"; `form` says what they are.
Vec2d parse_pair(const std::string& text, const std::string& option, const std::string& form);
std::size_t parse_memory(const std::string& text);                     // "4GiB", "800MiB", "2GB"
std::optional<sweep::Backend> parse_backend(const std::string& text);  // nothing for "auto"

// The place of the word among those that the option takes; for an unknown one the sentence names the nearest.
int index_of_word(const std::string& word, const std::vector<std::string>& words, const std::string& option);

// The value itself if it is a positive, finite number.
double require_positive(double value, const std::string& option);

// "4.2 GiB", "310 MiB".
std::string memory_text(std::size_t bytes);

}  // namespace skysweep::app
