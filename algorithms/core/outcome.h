// What a narrow phase answers.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "algorithms/core/vec.h"

namespace touchstone {

// What is asked. A query computes no more than its task.
enum class Task : std::uint8_t {
  intersect,    // do the bodies share a point
  distance,     // how far apart, with witness points; nothing but the answer where they overlap
  penetration,  // how deep, with normal and witness points; nothing but the answer where apart
};

enum class Answer : std::uint8_t { separated, touching, overlapping, unknown };

enum class Status : std::uint8_t {
  ok,             // the algorithm stands by its answer: wrong with `ok` is a silent error
  not_converged,  // the iteration cap or the end of the scalar's precision came first
  degenerate,     // the input is beyond what the algorithm can decide
  capacity,       // a fixed store was full
  unsupported,    // this kind of pair, or this task, is not one of the algorithm's
  not_reported,   // the library has no way to say whether it failed
  crashed,        // set by the harness: the query killed its process
  timed_out,      // set by the harness: the query was stopped
};

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
std::string_view to_string(Status status);
std::string_view to_string(Precision scalar);  // "float" or "double"

}  // namespace touchstone
