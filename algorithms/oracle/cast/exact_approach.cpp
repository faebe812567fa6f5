// Compares the depth in a swept body with the tolerance.
#include "algorithms/oracle/cast/exact_approach.h"

namespace touchstone::oracle {

Approach approach(Oracle& oracle, const Body& a, const Motion& motion_a, const Body& b,
                  const Motion& motion_b, double tolerance) {
  Body swept = a;
  swept.sweep = {motion_a.displacement, motion_b.displacement};
  const Measure measure = oracle.measure(swept, b);
  if (measure.lower >= -tolerance) return Approach::no;
  // No double is between the bounds of an exact answer.
  return measure.exact || measure.upper < -tolerance ? Approach::yes : Approach::unknown;
}

}  // namespace touchstone::oracle
