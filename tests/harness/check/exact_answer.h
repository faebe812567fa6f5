// The oracle's answer for a case.
#pragma once

#include "algorithms/oracle/exact_measure.h"
#include "harness/files/cases.h"

namespace touchstone {

inline oracle::ExactMeasure exact_measure(oracle::Oracle& oracle, const files::Case& c) {
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  return oracle.measure_exactly(oracle::Body(a, c.pose_a), oracle::Body(b, c.pose_b));
}

inline Answer exact_verdict(oracle::Oracle& oracle, const files::Case& c) {
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  return oracle.verdict(oracle::Body(a, c.pose_a), oracle::Body(b, c.pose_b));
}

}  // namespace touchstone
