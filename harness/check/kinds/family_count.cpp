// Counts grades.
#include "harness/check/kinds/family_count.h"

namespace touchstone::check {

std::string_view to_string(CaseForm form) {
  constexpr std::array<std::string_view, 6> names = {"as drawn", "swapped",  "scaled",
                                                     "moved",    "reversed", "split"};
  return names[static_cast<std::size_t>(form)];
}

void FamilyCount::add(const GradedCase& graded, std::int64_t index) {
  if (graded.grade == CaseGrade::not_asked) return;
  ++cases;
  contacts += graded.is_contact ? 1 : 0;
  bool is_bad = false;
  switch (graded.grade) {
    case CaseGrade::not_asked: break;
    case CaseGrade::unresolved: ++unresolved; break;
    case CaseGrade::right: ++right; break;
    case CaseGrade::near: ++near; break;
    case CaseGrade::honest: ++honest; break;
    case CaseGrade::missed: ++missed, is_bad = true; break;
    case CaseGrade::false_hit: ++false_hits, is_bad = true; break;
    case CaseGrade::wrong: ++wrong, is_bad = true; break;
    case CaseGrade::lost: ++lost, is_bad = true; break;
  }
  if (is_bad && first_wrong < 0) first_wrong = index;
}

void FamilyCount::add(const FamilyCount& other) {
  cases += other.cases;
  contacts += other.contacts;
  unresolved += other.unresolved;
  right += other.right;
  near += other.near;
  missed += other.missed;
  false_hits += other.false_hits;
  wrong += other.wrong;
  honest += other.honest;
  lost += other.lost;
  if (first_wrong < 0) first_wrong = other.first_wrong;
}

void add_to(FamilyCounts& sums, const FamilyCount& count) {
  FamilyCount& sum = sums[{count.contestant, count.family, count.form}];
  sum.family = count.family;
  sum.contestant = count.contestant;
  sum.form = count.form;
  sum.add(count);
}

}  // namespace touchstone::check
