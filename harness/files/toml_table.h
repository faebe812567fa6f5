// A table of a TOML file, read strictly: every fault is reported with file and line.
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

namespace touchstone::files {

// The range of a number, both ends included; NaN and infinity are never allowed.
struct Limits {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
};
inline constexpr Limits any_number{};
inline constexpr Limits not_negative{.low = 0};
inline constexpr Limits positive{.low = std::numeric_limits<double>::min()};

// Throws InputError if the file cannot be read or is not TOML.
toml::table parse_toml(const std::filesystem::path& file);
// True where the file has this key outside of any table, or with the key `TABLE.KEY` where a table of the array
// TABLE has it. Throws as parse_toml.
bool has_key(const std::filesystem::path& file, std::string_view key);

// Each read makes its key a known one; `finish` rejects unknown keys. A read without a fallback
// requires the key. All throw InputError.
class TomlTable {
 public:
  // `where` names the table in messages: "body 3"; it is empty for the file's own table.
  TomlTable(const toml::table& table, std::string file, std::string where)
      : table_(&table), file_(std::move(file)), where_(std::move(where)) {}

  const std::string& file() const { return file_; }
  const std::string& where() const { return where_; }
  std::int64_t line() const;                      // of the table
  std::int64_t line(std::string_view key) const;  // 0 if there is no such key
  bool has(std::string_view key) { return node(key) != nullptr; }
  // Like `has`, but the key does not become a known one.
  bool contains(std::string_view key) const { return table_->contains(key); }

  double number(std::string_view key, Limits limits, std::optional<double> fallback = {});
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {});
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  // The index in `names` of the given text.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names,
                     std::optional<std::size_t> fallback = {});
  // Like `choice`, for an element of an array.
  std::size_t choice_of(const toml::node& node, std::string_view key,
                        std::span<const std::string_view> names) const;
  Vec3d vector(std::string_view key, Limits limits, std::optional<Vec3d> fallback = {});
  std::vector<double> numbers(std::string_view key, std::size_t count, Limits limits);
  // An array of at least one point.
  std::vector<Vec3d> points(std::string_view key);
  // An array of at least one array of numbers, all of one length.
  std::vector<std::vector<double>> rows(std::string_view key);
  // Two numbers in ascending order; a single number stands for both.
  std::pair<double, double> range(std::string_view key, Limits limits,
                                  std::pair<double, double> fallback);
  // A table inside this one, and the tables of an array. `name` is for messages.
  TomlTable inside(std::string_view key, std::string name);
  std::vector<TomlTable> tables(std::string_view key);
  // The table's own keys in alphabetical order; all become known.
  std::vector<std::string> keys();

  // The elements of an array, of which there is at least one; a single value is an array of one.
  // Empty if there is no such key.
  std::vector<const toml::node*> elements(std::string_view key);
  std::vector<std::string> texts(std::string_view key, std::vector<std::string> fallback);
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high,
                                     std::int64_t fallback);

  // Null if there is no such key.
  const toml::node* node(std::string_view key);
  TomlTable from(const toml::node& element, std::string name) const;

  // Throws for every key that no read used.
  void finish() const;
  // Throws with the line of the key, or of the table if it has no such key.
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

// Returns the value of the key `name`, or without the key the stem of `file`, and `ending` behind it.
// Throws InputError with file and line if that cannot be the name of a folder (base::name_fault).
std::string folder_name(TomlTable& table, const std::filesystem::path& file,
                        const std::string& ending = "");

}  // namespace touchstone::files
