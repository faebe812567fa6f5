// How right one answer is, measured against the exact one.
#pragma once

#include <cstdint>
#include <string_view>

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::grade {

// What an answer is worth by its side of contact.
enum class Verdict : std::uint8_t {
  right,
  silent_error,    // the wrong side of contact, with status ok or not_reported
  honest_failure,  // no answer, or one that the algorithm does not stand by
  crashed,
  timed_out,
  unsupported,
  unscored,  // the bodies touch exactly, or the oracle's enclosure does not tell
};
std::string_view to_string(Verdict verdict);

inline bool is_contact(Answer answer) {
  return answer == Answer::touching || answer == Answer::overlapping;
}
// Whether the algorithm gave an answer, and either stands by it or cannot say.
bool stands_by(const Outcome& outcome);

// What bodies that touch exactly are taken for: an answer about them is not scored, or they are in
// contact.
enum class Touching : std::uint8_t { unscored, contact };
// Every judgement of a side of contact in the project is this one. The band in which a wrong side
// is forgiven is the caller's: see margins.h.
Verdict judge(const Outcome& outcome, Answer exact, Touching touching = Touching::unscored);

// All numbers are metres; NaN where the task does not ask for the number, the algorithm does not
// report it, or the bodies are not in the state that it is about. An error against an enclosure is
// by how far the number is outside of it. Numbers of an outcome that the algorithm does not stand
// by are not graded, its certified bounds are.
struct Grade {
  static constexpr double none = Outcome::none;

  Verdict verdict = Verdict::unscored;
  double margin = none;          // of a silent error: the exact |signed distance|, at least
  double distance_error = none;  // of a gap: reported less exact
  double depth_error = none;     // reported less exact: > 0 too deep
  // Along the reported normal n, of the support function h of the difference (for a half-space, of
  // the way along n until the bodies are separated):
  double separation_error = none;  // h(n)/|n| less the reported depth (or plus the gap): > 0 means
                                   // that this translation does not separate the bodies
  double excess = none;  // h(n)/|n| less the exact depth (or plus the gap): > 0 means that the
                         // direction is not the best
  double bounds_error = none;  // by how far the certified bounds miss the exact value; 0 is well
};

// Against the exact answer for two bodies. Touching and overlapping are one side of contact: how
// deep is a matter of the depth's error.
Grade grade(const Outcome& outcome, Task task, const oracle::Measure& exact, const oracle::Body& a,
            const oracle::Body& b);

// What an outcome reports beside its distance, against the bodies as the case has them.
struct WitnessGrade {
  static constexpr double none = Outcome::none;

  double off_body = none;      // metres: the greater distance of a witness point from its body
  double length_error = none;  // metres: |a - b| less |distance|
  double normal_error = none;  // | |n| - 1 |
  bool not_a_number = false;   // a vector with some NaN in it, an infinite number that is not the
                               // exact depth, or no distance where one was asked for and found
};

WitnessGrade grade_witnesses(const Outcome& outcome, Task task, const oracle::Body& a,
                             const oracle::Body& b, oracle::Oracle& oracle);

// Whether the task asks for a distance where the bodies are as answered.
bool asks_for_distance(Task task, Answer answer);

// Of the end of an enclosure that is nearer to zero; 0 where it holds zero.
double least_magnitude(double lower, double upper);

}  // namespace touchstone::grade
