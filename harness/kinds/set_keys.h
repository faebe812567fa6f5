// What the timed sets of all kinds share: the keys of their tables, and the hashes of answers.
#pragma once

#include <fmt/format.h>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"
#include "harness/kinds/timed_set.h"

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

// The entries that the key names; without it those of `fallback`.
template <class Entry>
std::vector<const Entry*> selected(files::TomlTable& table, std::span<const Entry> entries,
                                   std::string_view what, std::string_view key = "algorithms",
                                   const std::vector<std::string>& fallback = {"ours", "peers",
                                                                               "modules"}) {
  try {
    return kinds::select(entries, table.texts(key, fallback), what);
  } catch (const base::InputError& error) {
    table.fail(key, error.what());
  }
}

// The contestant that an entry is in a scalar, without its functions. Its name has the scalar where it offers several.
template <class Entry>
TimedContestant contestant_in(const Entry& entry, Precision scalar = Precision::float64) {
  TimedContestant made;
  made.name = entry.info.name;
  if constexpr (requires { entry.scalars; }) {
    if (entry.scalars.size() > 1) made.name += fmt::format(" {}", to_string(scalar));
  }
  made.origin = entry.info.origin;
  made.approximate = !entry.info.known_defect.empty();
  return made;
}

// Hashes of answers, by which those of two samples are compared.

// Every NaN has the same bits: it means that there is no number.
template <class Part>
std::uint64_t part_bits(const Part& part) {
  if constexpr (std::floating_point<Part>) {
    return std::isnan(part) ? 1 : std::bit_cast<std::uint64_t>(static_cast<double>(part));
  } else {
    return static_cast<std::uint64_t>(part);
  }
}

// The hash of numbers and enumerations in their order.
template <class... Parts>
std::uint64_t hash_of_parts(const Parts&... parts) {
  std::uint64_t hash = 0;
  ((hash = base::mix(hash ^ part_bits(parts))), ...);
  return hash;
}

inline std::uint64_t hash_of_point(const Vec3d& point) {
  return hash_of_parts(point.x(), point.y(), point.z());
}

// The hash of answers in their order; `hash_of` is that of one.
template <class Answer, class HashOf>
std::uint64_t hash_of_answers(std::span<const Answer> answers, const HashOf& hash_of) {
  std::uint64_t hash = 0;
  for (const Answer& answer : answers) hash = base::mix(hash ^ hash_of(answer));
  return hash;
}

inline std::uint64_t hash_of_outcome(const Outcome& outcome) {
  return hash_of_parts(outcome.answer, outcome.status, outcome.distance, outcome.lower,
                       outcome.upper);
}

}  // namespace touchstone::kinds
