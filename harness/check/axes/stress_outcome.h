// What became of one query of the sweep.
//
// An answer is wrong when it is on the wrong side of contact at all (bodies that touch exactly are
// on either), or when a number in it is off by more than the documented margin of
// harness/check/margins.h (a distance or depth: 1e-9 of the pair's scale in double, 1e-4 in float),
// and the algorithm stands by it or cannot say. Certified bounds that miss are wrong whatever the
// status. An approximate algorithm may call bodies overlapping that are apart; a depth that is
// labelled as a bound may be too great.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "harness/check/graded_answer.h"

namespace touchstone {

enum class StressOutcome : std::uint8_t {
  right,
  rounded,  // right about what the algorithm was given, wrong about the pair: the conversion of the
            // input to its scalar or frame did that
  honest,   // no answer, or one that the algorithm does not stand by
  silent,   // wrong, and nothing says so
  crashed,
  hung,
};
inline constexpr std::array<StressOutcome, 6> all_stress_outcomes = {
    StressOutcome::right,  StressOutcome::rounded, StressOutcome::honest,
    StressOutcome::silent, StressOutcome::crashed, StressOutcome::hung};

std::string_view to_string(StressOutcome outcome);

StressOutcome outcome_of(const NarrowPhaseEntry& entry, const GradedAnswer& answer, bool extreme);

// By how much, as a part of the scale: the exact signed distance that was called wrongly, and the
// greatest error of a number, against what was given; NaN where there is none.
double wrong_margin(const NarrowPhaseEntry& entry, const GradedAnswer& answer);
double worst_error(const NarrowPhaseEntry& entry, const GradedAnswer& answer);

}  // namespace touchstone
