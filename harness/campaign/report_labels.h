// What the tables call the rows' settings.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "harness/record/raw_row.h"

namespace touchstone {

inline std::string count_text(std::int64_t count) {
  if (count >= 1'000'000 && count % 1'000'000 == 0) return fmt::format("{}M", count / 1'000'000);
  return count >= 1000 && count % 1000 == 0 ? fmt::format("{}k", count / 1000)
                                            : std::to_string(count);
}

// The rows of the broad phases, or of the narrow ones, that hold a setting in more than one value:
// only those are worth a word in a label.
struct Varying {
  bool threads = false;
  bool boxes = false;
  bool isa = false;
  bool rebuild = false;

  Varying(const std::vector<RawRow>& rows, bool narrow) {
    std::set<std::int64_t> widths;
    std::set<std::string> kinds, limits;
    std::set<std::int64_t> rebuilds;
    for (const RawRow& row : rows) {
      if ((row.phase == Phase::narrow) != narrow) continue;
      widths.insert(row.threads);
      kinds.insert(row.boxes);
      limits.insert(row.isa_limit);
      rebuilds.insert(row.rebuild);
    }
    threads = widths.size() > 1;
    boxes = kinds.size() > 1;
    isa = limits.size() > 1;
    rebuild = rebuilds.size() > 1;
  }
  std::string label(const RawRow& row) const {
    return (boxes ? " " + row.boxes : "") + (threads ? fmt::format(" {}t", row.threads) : "") +
           (isa && !row.isa_limit.empty() ? " " + row.isa_limit : "") +
           (rebuild ? (row.rebuild == 1 ? " rebuilt" : " updated") : "");
  }
};

}  // namespace touchstone
