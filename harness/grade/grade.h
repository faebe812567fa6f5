// Grades of one answer: its side of contact and its numbers, against the exact answer.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::grade {

// Verdict on the side of contact of an answer.
enum class Verdict : std::uint8_t {
  right,
  silent_error,    // wrong side of contact, with status ok or not_reported
  honest_failure,  // no answer, or one that the algorithm does not stand by
  crashed,
  timed_out,
  unsupported,
  unscored,  // the bodies touch exactly, or the oracle's enclosure leaves the side open
};
std::string_view to_string(Verdict verdict);

inline bool is_contact(Answer answer) {
  return answer == Answer::touching || answer == Answer::overlapping;
}
// Returns whether the algorithm gave an answer, and either stands by it or reports no status.
bool stands_by(const Outcome& outcome);
// Returns whether the answer is `touching` within bounds on the signed distance (core/outcome.h).
bool is_within_resolution(const Outcome& outcome);
// Returns the length (metres) by which the outcome's bounds on the signed distance miss the exact
// one; 0 if they enclose it, NaN without bounds.
double bounds_error(const Outcome& outcome, const oracle::Measure& exact);

// The treatment of bodies that touch exactly: their answers are not scored, or they are in contact.
enum class Touching : std::uint8_t { unscored, contact };
// Judges the side of contact; all judgements in the project use this function. The caller applies
// the band in which a wrong side is tolerated: see margins.h. `touching` within bounds takes no side:
// it is right if the bounds hold, which the caller tests (bounds_error).
Verdict judge(const Outcome& outcome, Answer exact, Touching touching = Touching::unscored);

// Lengths in metres. A number is NaN if the task does not ask for it, the algorithm does not report
// it, or the bodies are not in the state that it describes. An error against an enclosure is the
// distance of the number from it. The numbers of an outcome that the algorithm does not stand by
// are not graded, except its certified bounds.
struct Grade {
  static constexpr double none = Outcome::none;

  Verdict verdict = Verdict::unscored;
  double margin = none;          // exact |signed distance| of a silent error, a lower bound
  double distance_error = none;  // reported gap less the exact one
  double depth_error = none;     // reported depth less the exact one: > 0 is too deep
  // The next two are along the reported normal n. h is the support function of the difference of
  // the bodies; for a half-space, h(n)/|n| is the way along n until the bodies are separated.
  // h(n)/|n| less the reported depth (or plus the gap): > 0 if this translation does not separate
  // the bodies.
  double separation_error = none;
  // h(n)/|n| less the exact depth (or plus the gap): > 0 if the direction is not the best.
  double excess = none;
  double bounds_error = none;  // distance by which the certified bounds miss; 0 is right
  double resolution = none;    // `touching` within bounds: the distance between these
};

// Grades an outcome against the exact answer for two bodies. Touching and overlapping are one side
// of contact; the error of the depth is graded apart.
Grade grade(const Outcome& outcome, Task task, const oracle::Measure& exact, const oracle::Body& a,
            const oracle::Body& b);

// Grades of the values beside the distance, against the bodies of the case.
struct WitnessGrade {
  static constexpr double none = Outcome::none;

  double off_body = none;      // metres: greatest distance of a witness point from its body
  double length_error = none;  // metres: |a - b| less |distance|
  double normal_error = none;  // | |n| - 1 |
  // True for a distance of separate bodies, or a depth of overlapping ones, without the normal or a
  // point. An infinite depth has no points.
  bool missing = false;
  // True for a vector that contains NaN, for an infinite number that is not the exact depth, or if
  // a distance that was asked for and found is missing.
  bool not_a_number = false;
};

WitnessGrade grade_witnesses(const Outcome& outcome, Task task, const oracle::Body& a,
                             const oracle::Body& b, oracle::Oracle& oracle);

// Returns whether the grade of an answer to the task is that of a depth.
inline bool grades_depth(Task task, const Grade& grade) {
  return task == Task::penetration ||
         (task == Task::signed_distance && !std::isnan(grade.depth_error));
}

// Returns the magnitude of the end nearer to zero; 0 if the enclosure contains zero.
double least_magnitude(double lower, double upper);

}  // namespace touchstone::grade
