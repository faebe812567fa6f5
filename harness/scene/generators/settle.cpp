// Moves a body until the exact signed distance has a given value, along the shortest way (settle)
// or along a given line (meet). Used by the generator pairs and by bench.
#include "harness/scene/generators/settle.h"

#include <algorithm>
#include <cmath>

namespace touchstone::scene {
namespace {

// The precision with which doubles of the size of the translations can place a body.
double tolerance_of(double distance) { return std::max(1e-6 * std::abs(distance), 4e-16); }

}  // namespace

bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance) {
  constexpr int most_steps = 30;
  const double tolerance = tolerance_of(distance);
  for (int step = 0; step < most_steps; ++step) {
    const oracle::Measure measure = oracle.measure({a, at_a}, {b, at_b});
    const double off = distance - measure.middle();
    if (std::abs(off) <= tolerance) return true;
    if (measure.normal.isZero()) return false;
    at_b.translation += off * measure.normal.normalized();
  }
  return false;
}

// Takes Newton's steps: along a line the signed distance is convex, so no step goes too far.
bool meet(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a, const oracle::Solid& b,
          Pose& at_b, const Vec3d& way, double distance) {
  constexpr int most_steps = 60;
  const double tolerance = tolerance_of(distance);
  for (int step = 0; step < most_steps; ++step) {
    const oracle::Measure measure = oracle.measure({a, at_a}, {b, at_b});
    const double off = measure.middle() - distance;
    if (std::abs(off) <= tolerance) return true;
    if (measure.normal.isZero()) return false;
    const Vec3d normal = measure.normal.normalized();
    const double slope = -(normal.x() * way.x() + normal.y() * way.y() + normal.z() * way.z());
    if (!(slope > 1e-3)) return false;  // beyond the nearest place, or almost
    at_b.translation += off / slope * way;
  }
  return false;
}

}  // namespace touchstone::scene
