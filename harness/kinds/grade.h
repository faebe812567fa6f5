// What one answer is worth: the grades of all kinds of queries, and their counts.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "algorithms/core/status.h"

namespace touchstone::kinds {

// One rule for every origin: each kind has one function that grades an answer, and all commands use it.
enum class Grade : std::uint8_t {
  not_asked,   // the algorithm does not take the query, or the form would round it
  unresolved,  // the exact answer is not known
  right,
  near,  // contact is reported where there is none, within the algorithm's tolerance; this is verified
  missed,     // no contact is reported where there is one
  false_hit,  // contact is reported where there is none, not within the tolerance
  inexact,  // the verdict is right; a number, pair, triangle or bound is off by more than the stated margin
  bound,  // the verdict is right; a number of an algorithm that gives upper bounds by design is off
  gave_up,  // the status says that the answer is not to be trusted, or there is no answer
  failed,   // a crash, or no answer in time
};
std::string_view to_string(Grade grade);

struct Graded {
  Grade grade = Grade::not_asked;
  bool is_contact = false;  // by the exact answer
};

// Counts of queries.
struct GradeCount {
  std::int64_t not_asked = 0;  // Grade::not_asked
  std::int64_t cases = 0;      // that were asked
  std::int64_t contacts = 0;   // of these, by the exact answer
  std::int64_t unresolved = 0, right = 0, near = 0, missed = 0, false_hits = 0, inexact = 0;
  std::int64_t bound = 0, gave_up = 0, failed = 0;
  std::int64_t first_wrong =
      -1;  // index of the first query that is missed, false, inexact or failed

  void add(const Graded& graded, std::int64_t index);
  void add(const GradeCount& other);
  // Answers that are wrong without a word: missed, false or inexact.
  std::int64_t silent() const { return missed + false_hits + inexact; }
  // As in contests of software verification: a right answer counts 1, one that is wrong without a word -16, and all
  // else 0.
  std::int64_t score() const { return right - 16 * silent(); }
};

// The columns that every file of such counts has.
template <class Counts, class Visit>
void grade_columns(Counts& row, const Visit& visit) {
  visit("near", row.near,
        "Contacts that are none, of what comes within the algorithm's tolerance; no fault.");
  visit("missed", row.missed, "Contacts that it does not report.");
  visit("false_hits", row.false_hits,
        "Contacts that it reports where there is none, not within its tolerance.");
  visit("inexact", row.inexact,
        "Answers whose verdict is right, and a number, a pair, a triangle or a bound is not.");
  visit("bound", row.bound, "Of these, upper bounds of an algorithm that gives them by design.");
  visit("gave_up", row.gave_up, "Answers that its status gives up.");
}

// True if an algorithm returns this status with an answer that it means: `ok`, or no status at all.
constexpr bool is_meant(Status status) {
  return status == Status::ok || status == Status::not_reported;
}

}  // namespace touchstone::kinds
