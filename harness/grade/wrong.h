// Whether a graded answer is wrong, by how much, and in words.
//
// An answer is wrong when the algorithm stands by it, or cannot say, and it is on the wrong side of
// contact or a number in it is beyond the documented margin (margins.h). Certified bounds that miss
// are wrong whatever the status. An approximate algorithm may call bodies overlapping that are
// apart; a depth that is labelled as a bound may be too great.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/registry.h"
#include "harness/grade/graded_answer.h"

namespace touchstone::grade {

// What became of a query. No margin forgives the wrong side of contact here; bodies that touch
// exactly are on either side.
enum class AnswerClass : std::uint8_t {
  right,
  rounded,  // right about what the algorithm was given, wrong about the pair: the conversion of the
            // input to its scalar or frame did that
  honest,   // no answer, or one that the algorithm does not stand by
  silent,   // wrong, and nothing says so
  crashed,
  hung,
};
inline constexpr std::array<AnswerClass, 6> all_answer_classes = {
    AnswerClass::right,  AnswerClass::rounded, AnswerClass::honest,
    AnswerClass::silent, AnswerClass::crashed, AnswerClass::hung};
std::string_view to_string(AnswerClass one);

AnswerClass class_of(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// The exact signed distance that was called wrongly, and the greatest error of a number, as a part
// of the scale, against what was given; NaN where there is none.
double wrong_margin(const NarrowPhaseEntry& entry, const GradedAnswer& answer);
double worst_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer);

// What of an answer is beyond the documented margins, end to end, in words; empty where nothing is.
std::string beyond_margins(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// What is wrong with an answer, in words: beyond the margins if `answer.beyond`, otherwise against
// what was given.
std::string describe(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// How bad an answer is against what was given; 0 where there is nothing to show. A crash is worse
// than a hang, that is worse than a silent error, and that is worse than a wrong number.
double badness(const GradedAnswer& answer);

}  // namespace touchstone::grade
