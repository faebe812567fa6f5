// The outcome of a narrow-phase query. Everything may include this.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "algorithms/core/status.h"
#include "algorithms/core/vec.h"

namespace touchstone {

// The task of a query, which computes no more than this.
enum class Task : std::uint8_t {
  intersect,        // do the bodies share a point?
  distance,         // the distance, with witness points; only the answer if they overlap
  penetration,      // the depth, with normal and witness points; only the answer if separated
  signed_distance,  // the distance if separated, the depth if overlapping, each as above
};
inline constexpr std::array all_tasks{Task::intersect, Task::distance, Task::penetration,
                                      Task::signed_distance};

// Whether the task needs the distance of bodies that are apart.
constexpr bool asks_distance(Task task) {
  return task == Task::distance || task == Task::signed_distance;
}
// Whether the task needs the depth of bodies that overlap.
constexpr bool asks_depth(Task task) {
  return task == Task::penetration || task == Task::signed_distance;
}

enum class Answer : std::uint8_t { separated, touching, overlapping, unknown };

// Whether the task asks for a number, with normal and witness points, if this is the answer. Every
// task but intersect may give what it knows of a pair whose answer is unknown.
constexpr bool asks_for_number(Task task, Answer answer) {
  if (answer == Answer::separated) return asks_distance(task);
  if (answer == Answer::overlapping) return asks_depth(task);
  return task != Task::intersect;
}

enum class Precision : std::uint8_t { float32, float64 };

// Fields that are not known are NaN. Those that the task does not need may stay as they were before
// the call: NaN in a new outcome; `only_given` clears them in one that was used before.
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

// Returns what the task gives with this answer, and nothing else: the answer, the status and the
// counts always; the bounds if the task asks for a number, or the answer is touching or unknown; the
// other numbers if the task asks for them and the answer is known.
inline Outcome only_given(Task task, const Outcome& outcome) {
  Outcome given = outcome;
  const bool known = outcome.answer != Answer::unknown;
  const bool asked = asks_for_number(task, outcome.answer);
  if (!asked && known && outcome.answer != Answer::touching) {
    given.lower = given.upper = Outcome::none;
  }
  if (!asked || !known) {
    given.distance = Outcome::none;
    given.normal = given.witness_a = given.witness_b = Vec3d::Constant(Outcome::none);
  }
  return given;
}

// Forgets all numbers but the counts.
inline void clear_numbers(Outcome& outcome) {
  outcome.distance = outcome.lower = outcome.upper = Outcome::none;
  outcome.normal = outcome.witness_a = outcome.witness_b = Vec3d::Constant(Outcome::none);
}

// Writes that the bodies are further apart than the margin that was set (NarrowPhaseSettings).
// `lower` bounds their distance (metres).
inline void write_beyond(double lower, Outcome& outcome) {
  clear_numbers(outcome);
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.lower = lower;
}

// Turns the outcome of the pair (a, b) into that of (b, a).
inline Outcome swapped(Outcome outcome) {
  outcome.normal = Vec3d::Zero() - outcome.normal;  // 0 - n keeps a zero positive
  const Vec3d on_a = outcome.witness_a;
  outcome.witness_a = outcome.witness_b;
  outcome.witness_b = on_a;
  return outcome;
}

std::string_view to_string(Task task);
std::string_view to_string(Answer answer);
std::string_view to_string(Precision scalar);  // "float" or "double"

}  // namespace touchstone
