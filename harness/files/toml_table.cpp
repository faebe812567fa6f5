// Strict reads of a TOML table, with messages that give file, line and key.
#include "harness/files/toml_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "harness/base/input_file.h"
#include "harness/base/names.h"

namespace touchstone::files {
namespace {

std::int64_t line_of(const toml::node& node) {
  return static_cast<std::int64_t>(node.source().begin.line);
}

// The value found, as a message shows it.
std::string show(const toml::node& node) {
  if (const auto* value = node.as_string()) return '"' + value->get() + '"';
  if (const auto* value = node.as_integer()) return std::to_string(value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_array()) return fmt::format("an array of {}", value->size());
  return node.is_table() ? "a table" : "a date or time";
}

std::string show(Limits limits) {
  if (limits.low == positive.low && limits.high == positive.high) return "a number > 0";
  if (limits.low == any_number.low && limits.high == any_number.high) return "a finite number";
  if (limits.high == any_number.high) return fmt::format("a number >= {}", limits.low);
  return fmt::format("a number from {} to {}", limits.low, limits.high);
}

}  // namespace

toml::table parse_toml(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = base::read_whole(path, base::longest_text, "a TOML file");
  try {
    return toml::parse(content, file);
  } catch (const toml::parse_error& error) {
    throw base::InputError(file, static_cast<std::int64_t>(error.source().begin.line),
                           std::string(error.description()) + "; expected TOML");
  }
}

bool has_key(const std::filesystem::path& file, std::string_view key) {
  const toml::table root = parse_toml(file);
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return root.contains(key);
  const toml::node* const tables = root.get(key.substr(0, dot));
  if (tables == nullptr || !tables->is_array()) return false;
  return std::ranges::any_of(*tables->as_array(), [&](const toml::node& node) {
    return node.is_table() && node.as_table()->contains(key.substr(dot + 1));
  });
}

void TomlTable::fail_at(const toml::node& node, std::string_view key,
                        const std::string& message) const {
  const std::string place = where_.empty() ? std::string(key) : fmt::format("{}: {}", where_, key);
  throw base::InputError(file_, line_of(node), place + ": " + message);
}

std::int64_t TomlTable::line() const { return line_of(*table_); }

std::int64_t TomlTable::line(std::string_view key) const {
  const toml::node* found = table_->get(key);
  return found == nullptr ? 0 : line_of(*found);
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  const toml::node* found = table_->get(key);
  fail_at(found != nullptr ? *found : *table_, key, message);
}

const toml::node* TomlTable::node(std::string_view key) {
  known_.emplace(key);
  return table_->get(key);
}

const toml::node& TomlTable::required(std::string_view key, std::string_view expected) {
  const toml::node* found = node(key);
  if (found == nullptr) fail(key, fmt::format("missing; expected {}", expected));
  return *found;
}

double TomlTable::checked(const toml::node& node, std::string_view key, Limits limits) const {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value) || *value < limits.low || *value > limits.high) {
    fail_at(node, key, fmt::format("found {}; expected {}", show(node), show(limits)));
  }
  return *value;
}

double TomlTable::number(std::string_view key, Limits limits, std::optional<double> fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked(required(key, show(limits)), key, limits);
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                std::optional<std::int64_t> fallback) {
  if (fallback && !has(key)) return *fallback;
  const std::string expected = fmt::format("a whole number from {} to {}", low, high);
  const toml::node& found = required(key, expected);
  const auto* value = found.as_integer();
  if (value == nullptr || value->get() < low || value->get() > high) {
    fail_at(found, key, fmt::format("found {}; expected {}", show(found), expected));
  }
  return value->get();
}

bool TomlTable::boolean(std::string_view key, bool fallback) {
  const toml::node* found = node(key);
  if (found == nullptr) return fallback;
  if (!found->is_boolean()) {
    fail_at(*found, key, fmt::format("found {}; expected true or false", show(*found)));
  }
  return found->as_boolean()->get();
}

std::string TomlTable::text(std::string_view key, std::optional<std::string> fallback) {
  if (fallback && !has(key)) return *fallback;
  const toml::node& found = required(key, "a text");
  if (!found.is_string()) {
    fail_at(found, key, fmt::format("found {}; expected a text", show(found)));
  }
  return found.as_string()->get();
}

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> names,
                              std::optional<std::size_t> fallback) {
  if (fallback && !has(key)) return *fallback;
  const std::string expected = fmt::format("one of {}", fmt::join(names, ", "));
  return choice_of(required(key, expected), key, names);
}

std::size_t TomlTable::choice_of(const toml::node& node, std::string_view key,
                                 std::span<const std::string_view> names) const {
  if (const auto* value = node.as_string()) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (value->get() == names[i]) return i;
    }
  }
  fail_at(node, key,
          fmt::format("found {}; expected one of {}", show(node), fmt::join(names, ", ")));
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, Limits limits) {
  const std::string expected = fmt::format("an array of {} numbers", count);
  const toml::node& found = required(key, expected);
  const toml::array* array = found.as_array();
  if (array == nullptr || array->size() != count) {
    fail_at(found, key, fmt::format("found {}; expected {}", show(found), expected));
  }
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(checked(element, key, limits));
  return values;
}

Vec3d TomlTable::checked_vector(const toml::node& node, std::string_view key, Limits limits) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3) {
    fail_at(node, key, fmt::format("found {}; expected an array of 3 numbers", show(node)));
  }
  Vec3d value;
  for (int i = 0; i < 3; ++i) {
    value[i] = checked((*array)[static_cast<std::size_t>(i)], key, limits);
  }
  return value;
}

Vec3d TomlTable::vector(std::string_view key, Limits limits, std::optional<Vec3d> fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked_vector(required(key, "an array of 3 numbers"), key, limits);
}

std::vector<Vec3d> TomlTable::points(std::string_view key) {
  constexpr std::string_view expected = "an array of at least one point of 3 numbers";
  const toml::node& found = required(key, expected);
  const toml::array* array = found.as_array();
  if (array == nullptr || array->empty()) {
    fail_at(found, key, fmt::format("found {}; expected {}", show(found), expected));
  }
  std::vector<Vec3d> points;
  for (const toml::node& point : *array) points.push_back(checked_vector(point, key, any_number));
  return points;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key) {
  required(key, "an array of rows of numbers");
  std::vector<std::vector<double>> rows;
  for (const toml::node* row : elements(key)) {
    const toml::array* numbers = row->as_array();
    if (numbers == nullptr || (!rows.empty() && numbers->size() != rows[0].size())) {
      fail_at(*row, key,
              fmt::format("row {} is {}; expected an array of numbers, as long as all rows",
                          rows.size() + 1, show(*row)));
    }
    std::vector<double>& values = rows.emplace_back();
    for (const toml::node& number : *numbers) values.push_back(checked(number, key, any_number));
  }
  return rows;
}

std::pair<double, double> TomlTable::range(std::string_view key, Limits limits,
                                           std::pair<double, double> fallback) {
  const toml::node* found = node(key);
  if (found == nullptr) return fallback;
  if (!found->is_array()) {
    const double value = checked(*found, key, limits);
    return {value, value};
  }
  const std::vector<double> ends = numbers(key, 2, limits);
  if (ends[0] > ends[1]) {
    fail_at(*found, key, fmt::format("found {} to {}; expected min <= max", ends[0], ends[1]));
  }
  return {ends[0], ends[1]};
}

TomlTable TomlTable::from(const toml::node& element, std::string name) const {
  if (!element.is_table()) {
    fail_at(element, name, fmt::format("found {}; expected a table", show(element)));
  }
  return TomlTable(*element.as_table(), file_, std::move(name));
}

TomlTable TomlTable::inside(std::string_view key, std::string name) {
  return from(required(key, "a table"), std::move(name));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node& found = required(key, "tables");
  const toml::array* array = found.as_array();
  if (array == nullptr || array->empty()) {
    fail_at(found, key,
            fmt::format("found {}; expected at least one table [[{}]]", show(found), key));
  }
  std::vector<TomlTable> tables;
  for (const toml::node& element : *array) {
    tables.push_back(from(element, fmt::format("{} {}", key, tables.size() + 1)));
  }
  return tables;
}

std::vector<const toml::node*> TomlTable::elements(std::string_view key) {
  const toml::node* const found = node(key);
  if (found == nullptr) return {};
  const toml::array* const array = found->as_array();
  if (array == nullptr) return {found};
  if (array->empty()) fail(key, "found an empty array; expected at least one value");
  std::vector<const toml::node*> list;
  for (const toml::node& element : *array) list.push_back(&element);
  return list;
}

std::vector<std::string> TomlTable::texts(std::string_view key, std::vector<std::string> fallback) {
  std::vector<std::string> values;
  for (const toml::node* element : elements(key)) {
    const auto* value = element->as_string();
    if (value == nullptr) fail(key, "expected texts");
    values.push_back(value->get());
  }
  return values.empty() ? fallback : values;
}

std::vector<std::int64_t> TomlTable::integers(std::string_view key, std::int64_t low,
                                              std::int64_t high, std::int64_t fallback) {
  std::vector<std::int64_t> values;
  for (const toml::node* element : elements(key)) {
    const auto* value = element->as_integer();
    if (value == nullptr || value->get() < low || value->get() > high) {
      fail(key, fmt::format("expected whole numbers from {} to {}", low, high));
    }
    values.push_back(value->get());
  }
  if (values.empty()) values.push_back(fallback);
  return values;
}

std::vector<std::string> TomlTable::keys() {
  std::vector<std::string> keys;
  for (const auto& [key, value] : *table_) keys.emplace_back(key.str());
  known_.insert(keys.begin(), keys.end());
  return keys;
}

void TomlTable::finish() const {
  // The first unknown key in the file, as a reader would find it.
  const toml::key* unknown = nullptr;
  for (const auto& [key, value] : *table_) {
    if (known_.contains(key.str())) continue;
    if (unknown == nullptr || key.source().begin < unknown->source().begin) unknown = &key;
  }
  if (unknown == nullptr) return;
  const std::string place = where_.empty() ? "" : where_ + ": ";
  throw base::InputError(file_, static_cast<std::int64_t>(unknown->source().begin.line),
                         fmt::format("{}unknown key {}; expected one of {}", place, unknown->str(),
                                     fmt::join(known_, ", ")));
}

std::string folder_name(TomlTable& table, const std::filesystem::path& file,
                        const std::string& ending) {
  std::string name = table.text("name", file.stem().string()) + ending;
  const std::string fault = base::name_fault(name);
  if (!fault.empty()) table.fail("name", fault);
  return name;
}

}  // namespace touchstone::files
