// Scenes at which rays are proven, and what the exact cast says about these rays, for tests.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "algorithms/oracle/certificates/parts/scene_ray_check.h"
#include "algorithms/oracle/rays/exact_scene_ray_proofs.h"
#include "tests/algorithms/certificates/bodies.h"

namespace touchstone::reference {

inline constexpr double no_end = std::numeric_limits<double>::infinity();

inline double value_of(const oracle::TimeFraction& t) {
  return mpq_class(oracle::rational(t.numerator) / oracle::rational(t.denominator)).get_d();
}

inline std::vector<oracle::PlacedBody> placed(const std::vector<SceneBody>& bodies) {
  std::vector<oracle::PlacedBody> all;
  for (const auto& [body, pose] : bodies) all.push_back({body, pose});
  return all;
}

inline SceneRayHit solved(const std::vector<SceneBody>& bodies,
                          const oracle::SceneRayCertificate& of) {
  const auto cast = registry::find<SceneRayCastEntry>("exact")->make();
  cast->bind(bodies);
  const Ray ray{of.origin, of.direction, of.t_max};
  SceneRayHit hit;
  cast->cast(of.is_first ? RayTask::closest : RayTask::any, {&ray, 1}, {&hit, 1});
  return hit;
}

// What is verified is true, however it came about: its answer is that of the exact cast, and its bracket holds the
// time; no other part is hit before the one that it names, if it claims an order. Its answer is known.
inline void expect_true(const std::vector<SceneBody>& bodies,
                        const oracle::SceneRayCertificate& verified) {
  const SceneRayHit hit = solved(bodies, verified);
  EXPECT_EQ(hit.hit, verified.answer == CastAnswer::hit);
  if (verified.answer != CastAnswer::hit) return;
  EXPECT_GE(value_of(verified.upper), hit.t * (1 - 1e-9));
  EXPECT_LE(value_of(verified.lower), hit.t * (1 + 1e-9));
  const bool is_named = hit.body == verified.body && hit.part == verified.part;
  if (!verified.is_first || !verified.is_ordered || is_named) return;
  EXPECT_LE(value_of(verified.upper), hit.t * (1 + 1e-9));
}

}  // namespace touchstone::reference
