// SPDX-License-Identifier: Apache-2.0
#include "app/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/error.h"
#include "settings/nearest_word.h"

namespace skysweep::app {
namespace {

// `count` finite numbers between commas.
std::vector<double> numbers(const std::string& text, std::size_t count, const std::string& option,
                            const std::string& form) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    while (at < end && *at == ' ') ++at;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) break;
    values.push_back(value);
    at = next;
    if (at < end && *at == ',')
      ++at;
    else
      break;
  }
  if (at != end || values.size() != count) throw usage_error(option + " takes " + form + ", not '" + text + "'.");
  return values;
}

}  // namespace

Vec3d parse_origin(const std::string& text) {
  const auto v = numbers(text, 3, "--origin", "X,Y,Z in metres");
  return {v[0], v[1], v[2]};
}

Vec3d parse_place(const std::string& text, const std::string& option) {
  const auto v = numbers(text, 3, option, "E,N,H in map coordinates, metres");
  return {v[0], v[1], v[2]};
}

Box2d parse_area(const std::string& text) {
  const auto v = numbers(text, 4, "--aoi", "x0,y0,x1,y1 in map coordinates");
  if (!(v[0] < v[2] && v[1] < v[3])) throw usage_error("--aoi takes x0,y0,x1,y1 with x0 < x1 and y0 < y1.");
  return {{v[0], v[1]}, {v[2], v[3]}};
}

sweep::HeightRange parse_height_range(const std::string& text) {
  const auto v = numbers(text, 2, "--z-range", "LOW,HIGH in metres");
  if (!(v[0] <= v[1])) throw usage_error("--z-range takes LOW,HIGH with LOW not above HIGH.");
  return {v[0], v[1]};
}

Vec2d parse_pair(const std::string& text, const std::string& option, const std::string& form) {
  const auto v = numbers(text, 2, option, form);
  return {v[0], v[1]};
}

std::size_t parse_memory(const std::string& text) {
  double value = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string unit(next, text.data() + text.size());
  double factor = 0;
  if (unit == "GiB" || unit == "G") factor = 1024.0 * 1024 * 1024;
  if (unit == "MiB" || unit == "M") factor = 1024.0 * 1024;
  if (unit == "GB") factor = 1e9;
  if (unit == "MB") factor = 1e6;
  if (error != std::errc() || !(value > 0) || factor == 0 || !(value * factor < 1e15))
    throw usage_error("--memory takes a size such as 4GiB or 800MiB, not '" + text + "'.");
  return static_cast<std::size_t>(value * factor);
}

std::optional<sweep::Backend> parse_backend(const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (text == "cpu") return sweep::Backend::cpu;
  if (text == "gpu") return sweep::Backend::gpu;
  if (text == "reference") return sweep::Backend::reference;
  throw usage_error("--backend takes auto, cpu, gpu or reference, not '" + text + "'.");
}

int index_of_word(const std::string& word, const std::vector<std::string>& words, const std::string& option) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<int>(found - words.begin());
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i)
    all += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  const std::optional<std::string> nearest = settings::nearest_word(word, words);
  throw usage_error(option + " takes " + all + ", not '" + word + "'" +
                    (nearest ? "; did you mean " + *nearest + "?" : "."));
}

double require_positive(double value, const std::string& option) {
  if (!(std::isfinite(value) && value > 0)) throw usage_error(option + " must be a positive number.");
  return value;
}

std::string memory_text(std::size_t bytes) {
  char text[32];
  const double mib = static_cast<double>(bytes) / (1 << 20);
  if (mib < 1024)
    std::snprintf(text, sizeof text, "%.0f MiB", mib);
  else
    std::snprintf(text, sizeof text, "%.1f GiB", mib / 1024);
  return text;
}

}  // namespace skysweep::app
