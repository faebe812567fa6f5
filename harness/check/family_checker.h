// The checker of all kinds whose cases are batches: counts of grades, by family, contestant and form.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "harness/kinds/checker.h"
#include "harness/kinds/kind.h"
#include "harness/record/row.h"

namespace touchstone::check {

using kinds::CheckMode;
using kinds::CheckRequest;

// Counts of what one contestant answers to the cases of one family in one form.
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

// The kind and the name: algorithms of two kinds may have one name.
inline std::string contestant_name(const kinds::Contestant& contestant) {
  return std::string(contestant.kind->name()) + " " + contestant.name();
}

template <record::row_of<FamilyCount> Row, class Visit>
void columns(Row& row, Visit visit, const CheckRequest& subjects) {
  visit("family",
        record::place_in(row.family, subjects.families.size(),
                         [&](std::size_t i) { return subjects.families[i]->name; }),
        "Family of the cases.");
  visit("group", record::derived([&] { return subjects.families[row.family]->group; }),
        "Group of the family.");
  visit("algorithm",
        record::place_in(row.contestant, subjects.contestants.size(),
                         [&](std::size_t i) { return contestant_name(subjects.contestants[i]); }),
        "The kind, the algorithm, its precision and its task.");
  visit("form", row.form, "Form of the cases; all but `as drawn` are asked for every fifth case.");
  visit("round", row.round, "Round of the check.");
  visit("cases", row.cases, "Cases that it was asked for.");
  visit("contacts", row.contacts, "Of these, contacts, hits or points inside by the exact answer.");
  visit("unresolved", row.unresolved, "Cases whose exact answer is not known.");
  visit("right", row.right, "Answers that are right.");
  kinds::grade_columns(row, visit);
  visit("failed", row.failed, "Queries that crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(row.first_wrong),
        "First case that is missed, false, inexact or failed; -1 where there is none.");
}

// A contestant that is wrong about cases of a family.
struct FamilyFailure {
  FamilyCount count;
  std::string command;  // asks for the first such case again
};

class FamilyChecker final : public kinds::RowChecker<FamilyChecker, FamilyCount> {
 public:
  static constexpr std::array row_files = {"families.csv"};

  // The request outlives it.
  explicit FamilyChecker(const CheckRequest& request) : request_(request) {}
  const CheckRequest& subjects() const { return request_; }
  kinds::JobRows<FamilyCount> rows_of_job(std::uint32_t family, std::uint64_t round);
  void add(const FamilyCount& count);

  // Writes the first case of each count that has missed, false, inexact or failed ones: all of ours, and one of a
  // family for each other contestant.
  void finish() override;
  std::vector<std::string> ours_wrong() const override;
  // A table for each kind: of cases and counts what each contestant got right and wrong; of axes the first values at
  // which it is wrong and at which it gives up.
  std::string text(std::size_t page_width) const override;
  std::string page(const std::string& pictures) const override;

  const FamilyCounts& counts() const { return counts_; }
  const std::vector<FamilyFailure>& failures() const { return failures_; }

 private:
  const CheckRequest& request_;
  FamilyCounts counts_;
  std::vector<FamilyFailure> failures_;
};

}  // namespace touchstone::check
