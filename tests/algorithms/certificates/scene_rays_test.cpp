// Answers to rays at scenes of several bodies are proven, and no forged one is.
#include <gtest/gtest.h>

#include <exception>
#include <vector>

#include "tests/algorithms/certificates/scene_rays.h"

namespace touchstone {
namespace {

using oracle::CheckedScene;
using oracle::SceneRayCertificate;
using oracle::SceneRayProver;
using reference::body_of;
using reference::expect_true;
using reference::moved_by;
using reference::no_end;
using reference::placed;
using reference::solved;
using reference::value_of;
using SceneStep = SceneRayCertificate::Step::Kind;

// Meshes, compounds and bodies without parts, near each other; every fourth scene lies on a half-space.
std::vector<SceneBody> random_scene(reference::Random& random, int number) {
  std::vector<SceneBody> bodies;
  const int count = 2 + random.below(8);
  for (int k = 0; k < count; ++k) {
    ConcaveBody body;
    switch (random.below(4)) {
      case 0: body = body_of(families::torus(7, 5, 0.5, 0.25)); break;
      case 1: body = body_of(families::box_mesh(0.5, 0.25, 0.5)); break;
      case 2: body = reference::compound(random, 1 + random.below(3), false, k == 1); break;
      default:
        if (random.below(4) > 0) {
          body = body_of(reference::shapes_of_all_kinds()[static_cast<std::size_t>(k % 7)]);
        }
        break;
    }
    bodies.push_back({body, {random.rotation(), random.vector(1.75)}});
  }
  if (number % 4 == 0) {
    bodies.push_back({body_of(reference::make_halfspace({0, 0, 1}, -3)), moved_by({0, 0, 0.25})});
  }
  return bodies;
}

Ray random_ray(reference::Random& random, double t_max) {
  const Vec3d origin = 5 * random.direction();
  return {origin, random.vector(1.5) - origin, t_max};
}

TEST(SceneRayCertificates, ScenesOfManyBodies) {
  reference::Random random(7);
  int hits = 0, misses = 0, unknown = 0, narrow = 0;
  std::vector<int> bodies_hit(16);
  for (int i = 0; i < drawn(60, 8); ++i) {
    const std::vector<SceneBody> bodies = random_scene(random, i);
    SceneRayProver prover(placed(bodies));
    CheckedScene checked(placed(bodies));
    for (int k = 0; k < 6; ++k) {
      const Ray ray = random_ray(random, k % 3 == 0 ? 0.75 : no_end);
      const bool is_first = k % 2 == 0;
      const auto proof = prover.prove(ray.origin, ray.direction, ray.t_max, is_first);
      ASSERT_TRUE(proof);
      EXPECT_EQ(checked.fault(*proof), "") << i;
      const SceneRayHit hit = solved(bodies, *proof);
      if (proof->answer == CastAnswer::unknown) {
        ++unknown;
        continue;
      }
      EXPECT_EQ(proof->answer == CastAnswer::hit, hit.hit) << i;
      ++(hit.hit ? hits : misses);
      if (!hit.hit) continue;
      EXPECT_EQ(proof->body, hit.body);
      EXPECT_EQ(proof->part, hit.part);
      ++bodies_hit[hit.body];
      const double lower = value_of(proof->lower), upper = value_of(proof->upper);
      EXPECT_NEAR(upper, hit.t, 1e-5 * hit.t);
      narrow += is_first && upper - lower <= 1e-9 * upper ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 120 / one_in);
  EXPECT_GT(misses, 60 / one_in);
  EXPECT_GT(narrow, 60 / one_in);
  EXPECT_LE(unknown, 4);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(bodies_hit[k], 0) << k;
}

// A certificate of the scene in which the body that is hit has no parts proves nothing of the scene itself, whatever
// is said of that body.
TEST(SceneRayCertificates, NoBodyIsHidden) {
  reference::Random random(9);
  int forged = 0, behind = 0;
  for (int i = 0; i < drawn(100, 12); ++i) {
    const std::vector<SceneBody> bodies = random_scene(random, i);
    const Ray ray = random_ray(random, no_end);
    const auto proof =
        *SceneRayProver(placed(bodies)).prove(ray.origin, ray.direction, ray.t_max, true);
    if (proof.answer != CastAnswer::hit || proof.upper.numerator == 0) continue;
    CheckedScene checked(placed(bodies));
    ASSERT_EQ(checked.fault(proof), "");
    std::vector<SceneBody> others = bodies;
    others[proof.body].body = {};
    const auto without =
        *SceneRayProver(placed(others)).prove(ray.origin, ray.direction, ray.t_max, true);
    ASSERT_EQ(CheckedScene(placed(others)).fault(without), "");
    if (without.answer == CastAnswer::unknown || without.cover.steps.empty()) continue;
    if (without.answer == CastAnswer::hit) {
      if (value_of(without.lower) <= value_of(proof.upper)) continue;  // at nearly one time
      ++behind;
    }
    const auto refused = [&](const SceneRayCertificate& c) {
      EXPECT_NE(checked.fault(c), "") << i;
      ++forged;
    };
    refused(without);
    for (std::size_t k = 0; k < without.cover.steps.size(); ++k) {
      // Each group, or body, has another cover.
      SceneRayCertificate c = without;
      c.cover.steps[k] = {SceneStep::body, {}};
      refused(c);
      c.of_bodies.emplace_back();
      refused(c);
      c.of_bodies.back() = {{0}, {{SceneStep::plane, {-1, 2, 1}}}};
      refused(c);
      c.cover.steps[k] = {SceneStep::plane, {1, -2, 3}};
      refused(c);
    }
    // The claim of the first with the cover of the second, which is until later, and the other way round.
    SceneRayCertificate c = proof;
    c.cover = without.cover;
    c.of_bodies = without.of_bodies;
    c.lower = without.lower;
    refused(c);
    c = proof;
    c.body = (proof.body + 1) % static_cast<std::uint32_t>(bodies.size());
    refused(c);
    if (without.answer != CastAnswer::hit) continue;
    c = without;
    c.cover = proof.cover;
    c.of_bodies = proof.of_bodies;
    refused(c);
  }
  EXPECT_GT(forged, 400 / one_in);
  EXPECT_GT(behind, 10 / one_in);
}

// Whatever is changed in a certificate: if it is verified, what it claims is true.
TEST(SceneRayCertificates, WhatIsVerifiedIsTrue) {
  reference::Random random(13);
  int verified = 0, refused = 0;
  for (int i = 0; i < drawn(40, 6); ++i) {
    const std::vector<SceneBody> bodies = random_scene(random, i);
    CheckedScene checked(placed(bodies));
    SceneRayProver prover(placed(bodies));
    const Ray ray = random_ray(random, no_end), next = random_ray(random, no_end);
    const auto proof = *prover.prove(ray.origin, ray.direction, ray.t_max, true);
    const auto other = *prover.prove(ray.origin, next.direction, ray.t_max, true);
    const auto any = [&](std::size_t size) {
      return static_cast<std::size_t>(random.below(static_cast<int>(size)));
    };
    for (int k = 0; k < 60; ++k) {
      SceneRayCertificate c = proof;
      for (int n = 0; n <= k % 2; ++n) {
        auto& steps = c.cover.steps;
        switch (random.below(11)) {
          case 10:
            // The bracket from the start on, with no cover: no order follows.
            c.lower = {};
            c.cover = {};
            c.of_bodies.clear();
            c.is_ordered = random.below(2) == 0;
            break;
          case 0: c.answer = static_cast<CastAnswer>(random.below(3)); break;
          case 1: c.lower.numerator *= random.below(3); break;
          case 2:
            c.upper = {c.upper.numerator * (900 + random.below(200)), c.upper.denominator * 1000};
            break;
          case 3: c.body = static_cast<std::uint32_t>(any(bodies.size())); break;
          case 4:
            c.cover = other.cover;
            c.of_bodies = other.of_bodies;
            break;
          case 5:
            if (!steps.empty()) std::swap(steps[any(steps.size())], steps[any(steps.size())]);
            break;
          case 6: c.t_max = random.uniform(0, 2); break;
          case 7: c.direction = other.direction; break;
          case 8:
            if (!steps.empty())
              steps[any(steps.size())].kind = static_cast<SceneStep>(random.below(5));
            break;
          default:
            if (!c.of_bodies.empty()) c.of_bodies[any(c.of_bodies.size())].steps.clear();
            break;
        }
      }
      const bool holds = checked.fault(c).empty();
      ++(holds ? verified : refused);
      if (!holds || c.answer == CastAnswer::unknown) continue;
      expect_true(bodies, c);
    }
  }
  EXPECT_GT(verified, 100 / one_in);
  EXPECT_GT(refused, 800 / one_in);
}

// A second ball on the way is in the bracket from the start to within it. To be the first that is hit, it would have to
// be reached before the other.
TEST(SceneRayCertificates, TheOrderIsProvenOrNotClaimed) {
  const std::vector<SceneBody> bodies = {
      {body_of(reference::make_sphere(0.5)), moved_by({0, 0, 5})},
      {body_of(reference::make_sphere(0.5)), moved_by({0, 0, 10})}};
  CheckedScene checked(placed(bodies));
  SceneRayCertificate second;
  second.direction = {0, 0, 1};
  second.answer = CastAnswer::hit;
  second.body = 1;
  second.upper = {10, 1};
  EXPECT_NE(checked.fault(second), "");
  second.is_ordered = false;
  EXPECT_EQ(checked.fault(second), "");
  second.is_first = false;
  EXPECT_EQ(checked.fault(second), "only a first hit may be without order");
  SceneRayProver prover(placed(bodies));
  const auto first = *prover.prove({0, 0, 0}, {0, 0, 1}, no_end, true);
  EXPECT_EQ(first.body, 0u);
  EXPECT_TRUE(first.is_ordered);
  EXPECT_EQ(checked.fault(first), "");
  // Two balls in one place, of which either may be first: the time is irrational, and the bracket has both.
  const std::vector<SceneBody> same = {bodies[0], bodies[0]};
  const auto either = *SceneRayProver(placed(same)).prove({0.1, 0.2, 0}, {0, 0, 1}, no_end, true);
  EXPECT_EQ(either.answer, CastAnswer::hit);
  EXPECT_FALSE(either.is_ordered);
  EXPECT_EQ(CheckedScene(placed(same)).fault(either), "");
}

TEST(SceneRayCertificates, NoBodiesBodiesWithoutPartsAndBodiesThatAreNone) {
  const Ray ray{{0, 0, 3}, {0, 0, -1}, no_end};
  const std::vector<SceneBody> none, hollow(3);
  for (const auto& bodies : {none, hollow}) {
    const auto proof =
        *SceneRayProver(placed(bodies)).prove(ray.origin, ray.direction, ray.t_max, true);
    EXPECT_EQ(proof.answer, CastAnswer::miss);
    CheckedScene checked(placed(bodies));
    EXPECT_EQ(checked.fault(proof), "");
    SceneRayCertificate changed = proof;
    changed.cover.steps.push_back({SceneStep::body, {}});
    EXPECT_NE(checked.fault(changed), "");
  }
  // One that is beyond repair is told before any certificate is looked at.
  TriangleMesh mesh = families::box_mesh(1, 1, 1);
  mesh.triangles[0][0] = 8;
  const std::vector<SceneBody> bad = {{body_of(families::box_mesh(1, 1, 1)), {}},
                                      {body_of(mesh), {}}};
  EXPECT_EQ(CheckedScene(placed(bad)).fault({}), "a triangle of the mesh names no vertex");
  EXPECT_THROW(SceneRayProver{placed(bad)}, std::exception);
}

}  // namespace
}  // namespace touchstone
