// SPDX-License-Identifier: Apache-2.0
#include "settings/toml_table.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "settings/nearest_word.h"
#include "settings/toml/node.h"

namespace skysweep::settings {

namespace {

// What stands there, for "must be a number, but is ...".
struct Describe {
  std::string operator()(bool) const { return "a boolean"; }
  std::string operator()(long long) const { return "a whole number"; }
  std::string operator()(double) const { return "a number with a fraction"; }
  std::string operator()(const std::string&) const { return "a string"; }
  std::string operator()(const TomlDate&) const { return "a date or time"; }
  std::string operator()(const TomlArray&) const { return "an array"; }
  std::string operator()(const std::shared_ptr<TomlNode>&) const { return "a table"; }
};

Error wrong_type(const std::string& where, const std::string& wanted, const TomlValue& found) {
  return usage_error(where + " must be " + wanted + ", but is " + std::visit(Describe{}, found.value));
}

template <typename T>
T expect(const TomlValue& value, const std::string& where, const char* wanted) {
  if (const T* found = std::get_if<T>(&value.value)) return *found;
  throw wrong_type(where, wanted, value);
}

double expect_number(const TomlValue& value, const std::string& where) {
  if (const auto* whole = std::get_if<long long>(&value.value)) return static_cast<double>(*whole);
  const double number = expect<double>(value, where, "a number");
  if (!std::isfinite(number)) throw usage_error(where + " must be a finite number, not inf or nan");
  return number;
}

std::string expect_string(const TomlValue& value, const std::string& where) {
  return expect<std::string>(value, where, "a string in quotes");
}

// Calls read(element, "file:line: path[i]") for each element of an array.
template <typename Read>
auto read_elements(const TomlValue& value, const std::string& where, const char* wanted, Read read) {
  std::vector<decltype(read(value, where))> result;
  for (const TomlValue& element : expect<TomlArray>(value, where, wanted))
    result.push_back(read(element, where + "[" + std::to_string(result.size()) + "]"));
  return result;
}

// Every key asked for counts as known, whether or not it is there.
const TomlEntry* ask(TomlNode& node, const std::string& key) {
  node.asked.insert(key);
  return node.find(key);
}

Error unknown_key(const TomlNode& node, const TomlEntry& entry) {
  std::string message = to_string(entry.place) + ": unknown key " + node.path_of(entry.key);
  if (const auto nearest = nearest_word(entry.key, {node.asked.begin(), node.asked.end()}))
    return usage_error(message + "; did you mean " + *nearest + "?");
  if (node.asked.empty()) return usage_error(message + "; nothing is read here, remove it");
  message += "; the keys known here are";
  for (const std::string& known : node.asked) message += (known == *node.asked.begin() ? " " : ", ") + known;
  return usage_error(message);
}

void refuse_unknown_in(const TomlNode& node);

void refuse_unknown_in(const TomlValue& value) {
  if (const auto* node = std::get_if<std::shared_ptr<TomlNode>>(&value.value)) return refuse_unknown_in(**node);
  if (const auto* array = std::get_if<TomlArray>(&value.value))
    for (const TomlValue& element : *array) refuse_unknown_in(element);
}

void refuse_unknown_in(const TomlNode& node) {
  for (const TomlEntry& entry : node.entries) {
    if (!node.asked.contains(entry.key)) throw unknown_key(node, entry);
    refuse_unknown_in(entry.value);
  }
}

}  // namespace

TomlTable TomlTable::read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw usage_error(path.string() + ": cannot be read; give the path of a TOML file");
  return parse({std::istreambuf_iterator<char>(file), {}}, path.string());
}

TomlTable TomlTable::parse(const std::string& text, const std::string& name) {
  return TomlTable(parse_toml(text, name));
}

std::string TomlTable::where(const std::string& key) const {
  const TomlEntry* entry = node_->find(key);
  return to_string(entry ? entry->place : node_->place) + ": " + node_->path_of(key);
}

bool TomlTable::has(const std::string& key) const { return ask(*node_, key) != nullptr; }

std::optional<double> TomlTable::number(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return expect_number(entry->value, where(key));
}

std::optional<long long> TomlTable::integer(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return expect<long long>(entry->value, where(key), "a whole number");
}

std::optional<bool> TomlTable::boolean(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return expect<bool>(entry->value, where(key), "true or false");
}

std::optional<std::string> TomlTable::string(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return expect_string(entry->value, where(key));
}

std::optional<std::vector<double>> TomlTable::numbers(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return read_elements(entry->value, where(key), "an array of numbers", expect_number);
}

std::optional<std::vector<std::string>> TomlTable::strings(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return read_elements(entry->value, where(key), "an array of strings", expect_string);
}

std::optional<TomlTable> TomlTable::table(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return std::nullopt;
  return TomlTable(expect<std::shared_ptr<TomlNode>>(entry->value, where(key), "a table"));
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return {};
  return read_elements(entry->value, where(key), "an array of tables",
                       [](const TomlValue& value, const std::string& at) {
                         return TomlTable(expect<std::shared_ptr<TomlNode>>(value, at, "a table"));
                       });
}

std::vector<TomlTable> TomlTable::one_or_more_tables(const std::string& key) const {
  const TomlEntry* entry = ask(*node_, key);
  if (!entry) return {};
  if (const auto* single = std::get_if<std::shared_ptr<TomlNode>>(&entry->value.value)) return {TomlTable(*single)};
  return tables(key);
}

void TomlTable::refuse_unknown() const { refuse_unknown_in(*node_); }

TomlTable layered(const TomlTable& base, const TomlTable& over) { return TomlTable(layered(*base.node_, *over.node_)); }

}  // namespace skysweep::settings
