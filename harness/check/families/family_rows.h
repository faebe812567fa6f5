// The columns of families.csv.
#pragma once

#include "harness/check/check_request.h"
#include "harness/check/families/family_count.h"
#include "harness/record/row.h"

namespace touchstone::check {

template <record::row_of<FamilyCount> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("family", record::place_in(row.family, subjects.families.size(), subjects.family_name()),
        "Family of the cases.");
  visit("group", record::derived([&] { return subjects.families[row.family]->group; }),
        "Group of the family.");
  visit("algorithm",
        record::place_in(row.contestant, subjects.contestants.size(), subjects.contestant_name()),
        "The kind, the algorithm, its precision and its task.");
  visit("form", row.form, "Form of the cases; all but `as drawn` are asked for every fifth case.");
  visit("round", row.round, "Round of the check.");
  visit("cases", row.cases, "Cases that it was asked for.");
  visit("contacts", row.contacts, "Of these, contacts, hits or points inside by the exact answer.");
  visit("unresolved", row.unresolved, "Cases whose exact answer is not known.");
  visit("right", row.right, "Answers that are right.");
  visit("near", row.near,
        "Contacts that are none, of bodies or features that come within the tolerance.");
  visit("missed", row.missed, "Contacts that it does not report.");
  visit("false_hits", row.false_hits,
        "Contacts that it reports where there is none, not within the tolerance.");
  visit("inexact", row.inexact,
        "Answers whose verdict is right, and a number, a pair, a triangle or a bound is not.");
  visit("bound", row.bound, "Of these, upper bounds of an algorithm that gives them by design.");
  visit("gave_up", row.gave_up, "Answers that its status gives up.");
  visit("failed", row.failed, "Queries that crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(row.first_wrong),
        "First case that is missed, false, inexact or failed; -1 where there is none.");
}

}  // namespace touchstone::check
