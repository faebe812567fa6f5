// The rule that decides whether an answer about two bodies that need not be convex is right.
#pragma once

#include <cstdint>

#include "algorithms/concave_phase.h"
#include "algorithms/core/outcome.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

// A distance may be off by so many times the reach.
inline constexpr double mesh_margin_double = 1e-11, mesh_margin_float = 1e-5;

// An answer in a form that another process can send. The pairs are those of parts that share a point.
struct MeshAnswer {
  Status status = Status::unsupported;
  Answer answer = Answer::unknown;
  double distance = Outcome::none, lower = Outcome::none, upper = Outcome::none;  // metres
  std::uint64_t pairs = 0, hash = 0;
};

// The greatest magnitude of a coordinate of both bodies, and some more (metres, at least 1).
double mesh_reach(const ConcaveBody& a, const Pose& pose_a, const ConcaveBody& b,
                  const Pose& pose_b);

// Whether the bodies share a point, and which of their parts do, is what `exact` says; how far they are apart is
// what `exact_distance` says, which is needed for ConcaveTask::distance alone.
Graded grade_mesh(ConcaveTask task, const MeshAnswer& answer, const MeshAnswer& exact,
                  const MeshAnswer* exact_distance, Precision scalar, double reach);

}  // namespace touchstone::kinds
