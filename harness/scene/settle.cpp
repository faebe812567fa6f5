#include "harness/scene/settle.h"

#include <algorithm>
#include <cmath>

namespace touchstone {

bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance) {
  constexpr int most_steps = 30;
  // What doubles of the size of the translations can place.
  const double tolerance = std::max(1e-6 * std::abs(distance), 4e-16);
  for (int step = 0; step < most_steps; ++step) {
    const oracle::Measure measure = oracle.measure({a, at_a}, {b, at_b});
    const double off = distance - measure.middle();
    if (std::abs(off) <= tolerance) return true;
    if (measure.normal.isZero()) return false;
    at_b.translation += off * measure.normal.normalized();
  }
  return false;
}

}  // namespace touchstone
