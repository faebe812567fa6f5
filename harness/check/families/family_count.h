// Counts of what one contestant answers to the cases of one family in one form.
#pragma once

#include <compare>
#include <cstdint>
#include <map>

#include "harness/kinds/batch.h"
#include "harness/kinds/grade.h"

namespace touchstone::check {

struct FamilyCount : kinds::GradeCount {
  std::uint32_t family = 0, contestant = 0;  // places in the request
  std::uint64_t round = 0;
  kinds::CaseForm form{};
};

// The sums over all rounds.
struct FamilyCountKey {
  std::uint32_t contestant, family;
  kinds::CaseForm form;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const FamilyCountKey&, const FamilyCountKey&) = default;
};
using FamilyCounts = std::map<FamilyCountKey, FamilyCount>;

inline void add_to(FamilyCounts& sums, const FamilyCount& count) {
  FamilyCount& sum = sums[{count.contestant, count.family, count.form}];
  sum.family = count.family;
  sum.contestant = count.contestant;
  sum.form = count.form;
  sum.add(count);
}

}  // namespace touchstone::check
