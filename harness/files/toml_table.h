// A table of a TOML file, read strictly: every fault is told with its file and line.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/vec.h"
#include "harness/base/error.h"

namespace touchstone {

// What a number may be, both ends included; NaN and infinity never.
struct Limits {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
};
inline constexpr Limits any_number{};
inline constexpr Limits not_negative{.low = 0};
inline constexpr Limits positive{.low = std::numeric_limits<double>::min()};

// Throws InputError where the file cannot be read or is no TOML.
toml::table parse_toml(const std::filesystem::path& file);

// Each read makes its key a known one; `finish` then refuses the others. A read without a fallback
// refuses a table without the key. All throw InputError.
class TomlTable {
 public:
  // `where` names the table in messages: "body 3"; empty for the file's own.
  TomlTable(const toml::table& table, std::string file, std::string where)
      : table_(&table), file_(std::move(file)), where_(std::move(where)) {}

  const std::string& file() const { return file_; }
  const std::string& where() const { return where_; }
  std::int64_t line() const;                      // of the table
  std::int64_t line(std::string_view key) const;  // 0 where there is no such key
  bool has(std::string_view key) { return node(key) != nullptr; }
  // The same without making the key a known one.
  bool contains(std::string_view key) const { return table_->contains(key); }

  double number(std::string_view key, Limits limits, std::optional<double> fallback = {});
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {});
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  // The place in `names` of the one that is given.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names,
                     std::optional<std::size_t> fallback = {});
  // The same for an element of an array.
  std::size_t choice_of(const toml::node& node, std::string_view key,
                        std::span<const std::string_view> names) const;
  Vec3d vector(std::string_view key, Limits limits, std::optional<Vec3d> fallback = {});
  std::vector<double> numbers(std::string_view key, std::size_t count, Limits limits);
  // Any number of points, at least one.
  std::vector<Vec3d> points(std::string_view key);
  // One number, or two in ascending order; one stands for both.
  std::pair<double, double> range(std::string_view key, Limits limits,
                                  std::pair<double, double> fallback);
  // A table inside this one, and the tables of an array. `name` is for messages.
  TomlTable inside(std::string_view key, std::string name);
  std::vector<TomlTable> tables(std::string_view key);
  // The table's own keys, in alphabetical order, each a known one.
  std::vector<std::string> keys();

  // Null where there is none.
  const toml::node* node(std::string_view key);
  TomlTable from(const toml::node& element, std::string name) const;

  // Refuses every key that no read has asked for.
  void finish() const;
  // At the key's line, or the table's where it has no such key.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  [[noreturn]] void fail_at(const toml::node& node, std::string_view key,
                            const std::string& message) const;
  double checked(const toml::node& node, std::string_view key, Limits limits) const;
  Vec3d checked_vector(const toml::node& node, std::string_view key, Limits limits) const;
  const toml::node& required(std::string_view key, std::string_view expected);

  const toml::table* table_;
  std::string file_, where_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace touchstone
