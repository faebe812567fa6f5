// Part of certified: a body prepared for each stage, and when a stage's result is the answer.
// Includes core, the oracle's solids and this folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/narrow_phase/certified/grid_points.h"
#include "algorithms/narrow_phase/certified/support_bounds.h"
#include "algorithms/oracle/solid.h"

namespace touchstone {

// A shape prepared for each stage. The shape must outlive this object.
struct PreparedShape {
  explicit PreparedShape(const Shape& s) : proven(s), solid(s) {
    split.reserve(solid.vertices.size());
    for (const Vec3d& vertex : solid.vertices) split.push_back(split_point(vertex));
  }

  BoundedShape proven;
  oracle::Solid solid;
  std::vector<SplitPoint> split;  // the solid's vertices

  const SupportShape<double>& support() const { return proven.support; }
  double size() const { return support().size + support().radius; }
  // Its vertices are exactly those of the shape, without a centre that is taken off.
  bool has_polytope() const {
    return solid.core == oracle::Solid::Core::polytope && support().is_near_origin;
  }
};

struct PlacedBody {
  const PreparedShape& shape;
  const Pose& pose;
};

// `tolerance` is relative to the size: the widest interval that is accepted as a distance or depth.
struct PlacedPair {
  PlacedBody a, b;
  double tolerance;
  double size() const { return std::max(a.shape.size(), b.shape.size()); }
  double widest() const { return tolerance * size(); }
  bool has_polytopes() const { return a.shape.has_polytope() && b.shape.has_polytope(); }
};

// Writes a proven answer, and the interval if the task asks for it or the bodies touch. Returns
// false and writes nothing if that is wider than `widest` (metres) and than two units in the last
// place.
inline bool write_answer(Answer answer, const DistanceBounds& gap, double widest, Task task,
                         Outcome& outcome) {
  if (asks_for_number(task, answer)) {
    // The nearer end is used, since the other may be infinite.
    const double magnitude = std::min(std::abs(gap.lower), std::abs(gap.upper));
    const double enough = std::max(widest, 2 * std::numeric_limits<double>::epsilon() * magnitude);
    if (!(gap.upper - gap.lower <= enough)) return false;
    outcome.lower = gap.lower;
    outcome.upper = gap.upper;
    outcome.distance = gap.lower + (gap.upper - gap.lower) / 2;
  } else if (answer == Answer::touching) {
    outcome.lower = outcome.upper = 0;
  }
  outcome.answer = answer;
  outcome.status = Status::ok;
  return true;
}

// Writes a proven verdict, to which no interval belongs.
inline bool write_verdict(Answer answer, Outcome& outcome) {
  return write_answer(answer, {}, 0, Task::intersect, outcome);
}

// Writes what the bounds on the signed distance decide. Returns false if they do not, or are too
// wide.
inline bool write_bounds(const DistanceBounds& gap, double widest, Task task, Outcome& outcome) {
  if (gap.lower > 0) return write_answer(Answer::separated, gap, widest, task, outcome);
  if (gap.upper < 0) return write_answer(Answer::overlapping, gap, widest, task, outcome);
  return false;
}

}  // namespace touchstone
