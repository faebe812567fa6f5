// Compares two sorted lists of pairs.
#include "harness/grade/pair_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace touchstone::grade {

PairFaults check_pairs(std::vector<IndexPair>& found, std::span<const IndexPair> truth,
                       std::span<const Aabb> before) {
  PairFaults faults;
  std::ranges::sort(found);
  std::optional<IndexPair> first_missing, first_extra, first_duplicate;
  const auto note = [](std::optional<IndexPair>& first, const IndexPair& pair) {
    if (!first) first = pair;
  };
  auto expected = truth.begin();
  for (auto at = found.begin(); at != found.end(); ++at) {
    if (at->a >= at->b || (at != found.begin() && *at == *std::prev(at))) {
      ++faults.duplicate;
      note(first_duplicate, *at);
      continue;
    }
    for (; expected != truth.end() && *expected < *at; ++expected) {
      ++faults.missing;
      note(first_missing, *expected);
    }
    if (expected != truth.end() && *expected == *at) {
      ++expected;
      continue;
    }
    const bool was = at->b < before.size() && overlap(before[at->a], before[at->b]);
    ++(was ? faults.stale : faults.extra);
    note(first_extra, *at);
  }
  for (; expected != truth.end(); ++expected) {
    ++faults.missing;
    note(first_missing, *expected);
  }
  faults.example = first_missing ? first_missing : first_extra ? first_extra : first_duplicate;
  return faults;
}

std::string to_string(const PairFaults& faults) {
  std::string text;
  const auto add = [&](std::int64_t count, const char* kind) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  };
  add(faults.missing, "missing");
  add(faults.stale, "stale");
  add(faults.extra, "extra");
  add(faults.duplicate, "duplicate");
  if (faults.example) text += fmt::format(" (first: {}-{})", faults.example->a, faults.example->b);
  return text;
}

}  // namespace touchstone::grade
