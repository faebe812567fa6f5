// Keys that kinds of cells share.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"

namespace touchstone::kinds {

// The indices of the names that the key lists; all of them without the key.
template <std::size_t size>
std::vector<std::size_t> choices(files::TomlTable& table, std::string_view key,
                                 const std::array<std::string_view, size>& names) {
  std::vector<std::size_t> chosen;
  for (const toml::node* node : table.elements(key))
    chosen.push_back(table.choice_of(*node, key, names));
  if (chosen.empty()) {
    chosen.resize(size);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  }
  return chosen;
}

// The numbers that the key lists, from `low` to `high`; none without the key.
inline std::vector<double> listed_numbers(files::TomlTable& table, std::string_view key, double low,
                                          double high, std::string_view what) {
  std::vector<double> numbers;
  for (const toml::node* node : table.elements(key)) {
    const std::optional<double> number = node->value<double>();
    if (!number || !(*number >= low && *number <= high))
      table.fail(key, fmt::format("expected {}, {} to {}", what, low, high));
    numbers.push_back(*number);
  }
  return numbers;
}

// The entries that the key `algorithms` names; ours and the peers' without it.
template <class Entry>
std::vector<const Entry*> selected(files::TomlTable& table, std::span<const Entry> entries,
                                   std::string_view what) {
  try {
    return kinds::select(entries, table.texts("algorithms", {"ours", "peers"}), what);
  } catch (const base::InputError& error) {
    table.fail("algorithms", error.what());
  }
}

}  // namespace touchstone::kinds
