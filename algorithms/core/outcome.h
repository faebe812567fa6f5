// What a narrow phase answers.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "algorithms/core/status.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// What is asked. A query computes no more than its task.
enum class Task : std::uint8_t {
  intersect,    // do the bodies share a point
  distance,     // how far apart, with witness points; nothing but the answer where they overlap
  penetration,  // how deep, with normal and witness points; nothing but the answer where apart
};

enum class Answer : std::uint8_t { separated, touching, overlapping, unknown };

enum class Precision : std::uint8_t { float32, float64 };

// Numbers that were not asked for, or are not known, are NaN.
struct Outcome {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  Answer answer = Answer::unknown;
  Status status = Status::unsupported;
  double distance = none;  // metres; > 0 the gap, < 0 minus the penetration depth
  double lower = none;     // certified bounds on the signed distance, where the algorithm has them
  double upper = none;
  // Unit vector from a to b in the world. Apart: along the shortest connection. Overlapping: moving
  // b by depth * normal separates the bodies.
  Vec3d normal = Vec3d::Constant(none);
  // Witness points in the world: on a and on b; apart, the closest points; overlapping, the points
  // with witness_a - witness_b = depth * normal.
  Vec3d witness_a = Vec3d::Constant(none);
  Vec3d witness_b = Vec3d::Constant(none);
  std::int32_t iterations = -1;     // -1: not counted
  std::int32_t support_calls = -1;  // -1: not counted
};

std::string_view to_string(Task task);
std::string_view to_string(Answer answer);
std::string_view to_string(Precision scalar);  // "float" or "double"

}  // namespace touchstone
