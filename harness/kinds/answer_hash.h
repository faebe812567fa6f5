// Hashes of answers, by which those of two samples are compared.
#pragma once

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>

#include "algorithms/core/outcome.h"
#include "harness/base/hash.h"

namespace touchstone::kinds {

// Every NaN has the same bits: it means that there is no number.
template <class Part>
std::uint64_t part_bits(const Part& part) {
  if constexpr (std::floating_point<Part>) {
    return std::isnan(part) ? 1 : std::bit_cast<std::uint64_t>(static_cast<double>(part));
  } else {
    return static_cast<std::uint64_t>(part);
  }
}

// The hash of numbers and enumerations in their order.
template <class... Parts>
std::uint64_t hash_of_parts(const Parts&... parts) {
  std::uint64_t hash = 0;
  ((hash = base::mix(hash ^ part_bits(parts))), ...);
  return hash;
}

inline std::uint64_t hash_of_point(const Vec3d& point) {
  return hash_of_parts(point.x(), point.y(), point.z());
}

// The hash of answers in their order; `hash_of` is that of one.
template <class Answer, class HashOf>
std::uint64_t hash_of_answers(std::span<const Answer> answers, const HashOf& hash_of) {
  std::uint64_t hash = 0;
  for (const Answer& answer : answers) hash = base::mix(hash ^ hash_of(answer));
  return hash;
}

inline std::uint64_t hash_of_outcome(const Outcome& outcome) {
  return hash_of_parts(outcome.answer, outcome.status, outcome.distance, outcome.lower,
                       outcome.upper);
}

}  // namespace touchstone::kinds
