// Names that are nearly others, for messages about a slip of the pen.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::base {

// Returns how many letters to insert, delete, replace or exchange with the next make one of the other.
inline std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) last[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      row[k] =
          std::min({last[k] + 1, row[k - 1] + 1, last[k - 1] + (a[i - 1] != b[k - 1] ? 1 : 0)});
      const bool exchanged = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
      if (exchanged) row[k] = std::min(row[k], before[k - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

// The known name that was meant, if one is so near that it is a slip; a known name is none.
inline std::optional<std::string_view> meant_name(std::string_view name,
                                                  std::span<const std::string_view> known) {
  if (name.size() > 40) return std::nullopt;
  const auto near =
      std::ranges::min_element(known, {}, [&](std::string_view one) { return edits(one, name); });
  if (near == known.end() || *near == name) return std::nullopt;
  const bool is_slip = edits(*near, name) <= std::min<std::size_t>(2, name.size() / 3);
  return is_slip ? std::optional(*near) : std::nullopt;
}

// Returns "no WHAT is called 'NAME'; did you mean X?", or a list of all that are known if none is near.
inline std::string unknown_name(std::string_view what, std::string_view name,
                                std::span<const std::string_view> known) {
  const std::string start = fmt::format("no {} is called '{}'; ", what, name);
  if (const auto meant = meant_name(name, known)) {
    return start + fmt::format("did you mean {}?", *meant);
  }
  return start + fmt::format("expected some of {}", fmt::join(known, ", "));
}

}  // namespace touchstone::base
