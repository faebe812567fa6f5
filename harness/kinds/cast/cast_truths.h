// What is right of moving bodies, by the oracle.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/oracle/oracle.h"
#include "harness/files/cases.h"

namespace touchstone::kinds {

// The greatest magnitude of a coordinate of both bodies and their motions, seen from where the first one
// begins (metres).
double span_of_motion(const files::CastCase& c);

// Answers are found when they are first asked for. The cases stay where they are.
class CastTruths {
 public:
  explicit CastTruths(std::span<const files::CastCase> cases);

  // The greatest magnitude of a coordinate of both bodies and their motions (metres).
  double reach(std::size_t i) const { return reaches_[i]; }
  // The greatest length that a point of the bodies moves relative to the other body (metres).
  double path(std::size_t i) const;
  const CastOutcome& of(std::size_t i);
  // Where contact at the start counts only if the bodies approach: unknown where their depth is within
  // rounding of the tolerance, or no exact answer is known.
  CastOutcome of_approach(std::size_t i, double tolerance);
  // True if the bodies are further apart at the time than the tolerance, and rounding of their places.
  bool is_apart(std::size_t i, double time, double tolerance);

 private:
  enum class Depth : std::uint8_t { none, some, unknown };  // more than the tolerance, or not

  oracle::Measure measure_at(std::size_t i, double time);
  Depth depth_on_the_way(std::size_t i, double tolerance);

  std::span<const files::CastCase> cases_;
  std::vector<double> reaches_;
  std::vector<std::optional<CastOutcome>> exact_;
  std::vector<std::optional<oracle::Measure>> least_;  // the depth along the best fixed direction
  oracle::Oracle oracle_;
};

}  // namespace touchstone::kinds
