// The outcome of a narrow-phase query. Everything may include this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "algorithms/core/status.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// The task of a query, which computes no more than this.
enum class Task : std::uint8_t {
  intersect,    // do the bodies share a point?
  distance,     // the distance, with witness points; only the answer if they overlap
  penetration,  // the depth, with normal and witness points; only the answer if separated
};

enum class Answer : std::uint8_t { separated, touching, overlapping, unknown };

enum class Precision : std::uint8_t { float32, float64 };

// Fields that the task does not need, or that are not known, are NaN.
//
// `touching` without bounds, or with both zero, says that the bodies have common points and no
// common interior. With other bounds, `lower` <= 0 <= `upper` for every task, it says that the signed
// distance lies within them: the algorithm's arithmetic cannot tell more, and documents how far apart
// they may be. To a yes or
// no question both are a yes, because closed bodies that touch share a point.
struct Outcome {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  double distance = none;  // metres; > 0 the gap, < 0 minus the penetration depth
  double lower = none;     // certified bounds on the signed distance, if the algorithm has them
  double upper = none;
  // Unit vector from a to b in the world. Separated: along the shortest connection. Overlapping:
  // moving b by depth * normal separates the bodies.
  Vec3d normal = Vec3d::Constant(none);
  // Witness points in the world, on a and on b. Separated: the closest points. Overlapping: the
  // points with witness_a - witness_b = depth * normal.
  Vec3d witness_a = Vec3d::Constant(none);
  Vec3d witness_b = Vec3d::Constant(none);
  std::int32_t iterations = -1;     // -1: not counted
  std::int32_t support_calls = -1;  // -1: not counted
};
// Kernels that answer several pairs at once (kernels/batch) write the status together with the
// answer before it, and the twelve numbers from the distance to the second witness point in a row.
static_assert(offsetof(Outcome, status) == offsetof(Outcome, answer) + 1);
static_assert(offsetof(Outcome, normal) == offsetof(Outcome, distance) + 3 * sizeof(double));
static_assert(offsetof(Outcome, witness_a) == offsetof(Outcome, normal) + 3 * sizeof(double));
static_assert(offsetof(Outcome, witness_b) == offsetof(Outcome, witness_a) + 3 * sizeof(double));

std::string_view to_string(Task task);
std::string_view to_string(Answer answer);
std::string_view to_string(Precision scalar);  // "float" or "double"

}  // namespace touchstone
