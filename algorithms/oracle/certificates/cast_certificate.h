// Part of the oracle: what proves the answer of a cast. harness/files reads and writes it.
//
// Free: planes. Each is a direction n, any nonzero vector, and the time until which it parts the bodies, from
// where the one before it ends. Without rotation the gap along n is linear in time, so that it is enough if
// it is > 0 at the first of these times and >= 0 at the second: the bodies share no point before the last
// plane's end. Where a body turns, its points get nearer to the other along n by at most
// h (|n x w| rho - n . v) in a time h, with rho the greatest distance of its points from its origin.
//
// Contact at `upper`: points of the difference A - B of the cores, as in certificate.h. Either one convex
// combination that is within the radii, or a closed surface around 0.
//
// The exact time: of polytopes and balls around them that do not turn, the time of impact is rational, and
// then `lower` = `upper`, or the root of a quadratic. That is proven by a feature, one to three points of
// the difference. At that time the point of its plane, line or point that is nearest to 0 is as far as the
// radii are long; it lies in the feature, no point of the difference is in front of it, and the bodies
// close along it. Signs of polynomials at the root decide all of that.
#pragma once

#include <array>
#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/core/motion.h"
#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// A body at time 0, which then moves.
struct MovingBody {
  Body body;
  Motion motion;
};

// A time as a fraction; the denominator is positive.
struct TimeFraction {
  Integer numerator = 0;
  Integer denominator = 1;
};

struct CastCertificate {
  // The claim. A miss: no common point at any time in [0, 1]. A hit: a common point at `upper`, and none
  // before `lower`. Unknown: none before `lower` alone.
  CastAnswer answer = CastAnswer::unknown;
  TimeFraction lower, upper;

  struct Plane {
    TimeFraction until;
    IntegerVector direction{};  // from a to b, world axes
  };
  std::vector<Plane> planes;  // in order of time

  std::vector<Generator> a, b;
  std::vector<Certificate::Term> closest;
  Certificate::Surface surface;

  // If there is a feature, the time of impact is the only root in [lower, upper] of
  // polynomial[0] + polynomial[1] t + polynomial[2] t^2, which is > 0 at `lower` and <= 0 at `upper`.
  std::vector<DifferencePoint> feature;
  std::array<Integer, 3> polynomial{};
};

}  // namespace touchstone::oracle
