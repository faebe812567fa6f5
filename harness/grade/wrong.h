// Decides whether a graded answer is wrong, by how much, and describes it in words.
//
// An answer that its algorithm stands by is wrong if it is on the wrong side of contact or
// contains a number beyond the documented margin (margins.h). Certified bounds that miss are wrong
// whatever the status. Of ours, a distance also needs a normal, and witness points on the bodies.
// An approximate algorithm may report separate bodies as overlapping; a depth
// that is labelled as a bound may be too great.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/registry.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::grade {

// Classes of answers. The wrong side of contact counts here whatever its margin; for bodies that
// touch exactly either side is right.
enum class AnswerClass : std::uint8_t {
  right,
  // Right for the given problem but wrong for the case: the conversion of the input to the
  // algorithm's scalar or frame caused the error.
  rounded,
  honest,  // no answer, or one that the algorithm does not stand by
  silent,  // wrong without any sign of it
  crashed,
  hung,
};
inline constexpr std::array<AnswerClass, 6> all_answer_classes = {
    AnswerClass::right,  AnswerClass::rounded, AnswerClass::honest,
    AnswerClass::silent, AnswerClass::crashed, AnswerClass::hung};
std::string_view to_string(AnswerClass one);

AnswerClass class_of(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// Return the exact signed distance of a wrong verdict, and the greatest error of a number, as parts
// of the scale, against the given problem; NaN if there is none.
double wrong_margin(const NarrowPhaseEntry& entry, const GradedAnswer& answer);
double worst_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer);

// Describes the excess over the documented margins, end to end; empty if there is none.
std::string beyond_margins(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// Describes what is wrong with an answer: beyond the margins if `answer.beyond`, otherwise against
// the given problem.
std::string describe(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// Returns how bad an answer is against the given problem; 0 if it is right. A crash is worse than a
// hang, a hang worse than a silent error, and that is worse than a wrong number.
double badness(const GradedAnswer& answer);

}  // namespace touchstone::grade
