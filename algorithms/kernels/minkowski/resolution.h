// The answer `touching` of algorithms that compute in floating point. Used by every narrow phase
// that bounds the signed distance.
//
// Rounding hides on which side of contact two bodies are that touch, or nearly do. An algorithm
// that has bounds on the signed distance then says how near to contact they are.
#pragma once

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// The widest bounds that mean `touching`, as a part of the pair's unit, which is above the pair's
// size and at most twice that: 2.9e-14 (double) or 1.6e-5 (float).
template <class Scalar>
inline constexpr double resolution = 8 * static_cast<double>(SupportPair<Scalar>::rounding);

// Returns true if the bounds enclose zero and are no further apart than `widest`.
template <class Scalar>
bool are_at_contact(Scalar lower, Scalar upper, Scalar widest) {
  return lower <= 0 && upper >= 0 && upper - lower <= widest;
}

// Writes `touching` with these bounds on the signed distance (metres) and returns true if they are
// at contact. Otherwise changes nothing.
inline bool write_if_touching(double lower, double upper, double widest, Outcome& outcome) {
  if (!are_at_contact(lower, upper, widest)) return false;
  outcome.answer = Answer::touching;
  outcome.status = Status::ok;
  outcome.lower = lower;
  outcome.upper = upper;
  return true;
}

}  // namespace touchstone
