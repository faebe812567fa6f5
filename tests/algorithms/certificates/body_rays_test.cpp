// Answers to rays at bodies of many parts are proven, and no changed claim is.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "harness/families/aimed_queries.h"
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
using reference::solved;
using reference::value_of;
using RayKind = SceneRayCertificate::Step::Kind;

struct RayCounts {
  int hits = 0, misses = 0, unknown = 0, exact = 0, narrow = 0;
};

void expect_ray_proven(const ConcaveBody& body, const Pose& pose, const Ray& ray,
                       const std::string& what, RayCounts& counts) {
  SceneRayProver prover({{body, pose}});
  CheckedScene checked({{body, pose}});
  for (const bool is_first : {true, false}) {
    const auto proof = prover.prove(ray.origin, ray.direction, ray.t_max, is_first);
    ASSERT_TRUE(proof) << what;
    EXPECT_EQ(checked.fault(*proof), "") << what;
    const SceneRayHit hit = solved({{body, pose}}, *proof);
    switch (proof->answer) {
      case CastAnswer::unknown: ++counts.unknown; continue;
      case CastAnswer::miss:
        ++counts.misses;
        EXPECT_FALSE(hit.hit) << what;
        continue;
      default: break;
    }
    ++counts.hits;
    EXPECT_TRUE(hit.hit) << what;
    const double lower = value_of(proof->lower), upper = value_of(proof->upper);
    EXPECT_NEAR(upper, hit.t, 1e-5 * hit.t) << what;
    if (!is_first) continue;
    EXPECT_LE(lower, hit.t * (1 + 1e-9)) << what;
    counts.exact += lower == upper ? 1 : 0;
    counts.narrow += upper - lower <= 1e-9 * upper ? 1 : 0;
  }
}

TEST(BodyRayCertificates, ShapesOfAllKinds) {
  reference::Random random(3);
  const std::vector<Shape> shapes = reference::shapes_of_all_kinds();
  for (std::size_t kind = 0; kind < shapes.size(); ++kind) {
    RayCounts counts;
    for (int i = 0; i < 40; ++i) {
      Pose inner{random.rotation(), random.vector(0.25)},
          outer{random.rotation(), random.vector(0.5)};
      if (i % 4 == 0) inner.rotation.col(1) *= 1.5;
      if (i % 5 == 0) outer.rotation *= -2;
      const Vec3d origin =
          i % 10 == 0 ? outer(inner(Vec3d::Constant(0.125))) : Vec3d(3 * random.direction());
      const Vec3d at = outer(inner.translation) + random.vector(1);
      const Ray ray{origin, at - origin, i % 3 == 0 ? 0.9 : no_end};
      const std::string what = "kind " + std::to_string(kind) + ", ray " + std::to_string(i);
      expect_ray_proven(body_of(shapes[kind], inner), outer, ray, what, counts);
    }
    EXPECT_GT(counts.hits, 10) << kind;
    EXPECT_GT(counts.misses, 10) << kind;
    EXPECT_LE(counts.unknown, 2) << kind;
    EXPECT_GT(counts.narrow, counts.hits / 2 - 3) << kind;
  }
}

TEST(BodyRayCertificates, CompoundsAndMeshes) {
  reference::Random random(5);
  RayCounts counts;
  for (int i = 0; i < 60; ++i) {
    const ConcaveBody body = i % 3 == 0 ? body_of(families::torus(16, 9, 1, 0.5, true))
                                        : reference::compound(random, 4, i % 4 == 0, i % 2 == 0);
    const Pose pose{random.rotation(), random.vector(1)};
    const Vec3d origin = 4 * random.direction();
    const Ray ray{origin, random.vector(1.5) - origin, i % 5 == 0 ? 1.0 : no_end};
    expect_ray_proven(body, pose, ray, "ray " + std::to_string(i), counts);
  }
  EXPECT_GT(counts.hits, 40);
  EXPECT_GT(counts.misses, 15);
  EXPECT_GT(counts.exact, 5);
  EXPECT_LE(counts.unknown, 4);
}

// At edges and corners of a mesh, along its faces, and off by nothing.
TEST(BodyRayCertificates, RaysAimedAtMeshes) {
  const TriangleMesh mesh = families::box_mesh(1, 0.5, 0.25);
  RayCounts counts;
  Pose pose = moved_by({0.125, 0.25, 2});
  pose.rotation.col(0) *= 2;
  for (Ray ray : families::aimed_rays(mesh, 1, 3)) {
    ray.origin = pose(ray.origin);
    ray.direction = pose.rotation * ray.direction;
    expect_ray_proven(body_of(mesh), pose, ray, "aimed", counts);
  }
  EXPECT_EQ(counts.unknown, 0);
  EXPECT_GT(counts.hits, 50);
  EXPECT_GT(counts.misses, 10);
  EXPECT_EQ(counts.exact, counts.hits / 2);
}

TEST(BodyRayCertificates, EveryChangeIsRefused) {
  reference::Random random(8);
  int changes = 0;
  for (int i = 0; i < 40; ++i) {
    const ConcaveBody body = i % 2 == 0 ? body_of(families::torus(7, 5, 1, 0.5))
                                        : reference::compound(random, 3, i % 4 == 1, false);
    const Pose pose{random.rotation(), random.vector(1)};
    CheckedScene checked({{body, pose}});
    const Vec3d origin = 4 * random.direction();
    const auto proof =
        *SceneRayProver({{body, pose}}).prove(origin, random.vector(1.5) - origin, no_end, true);
    ASSERT_EQ(checked.fault(proof), "");
    const auto refused = [&](const std::string& what,
                             const std::function<void(SceneRayCertificate&)>& change) {
      SceneRayCertificate changed = proof;
      change(changed);
      EXPECT_NE(checked.fault(changed), "") << what << " of " << i;
      ++changes;
    };
    refused("no direction", [](auto& c) { c.direction.setZero(); });
    refused("no end", [](auto& c) { c.t_max = std::nan(""); });
    refused("no answer", [](auto& c) { c.answer = static_cast<CastAnswer>(7); });
    refused("no time", [](auto& c) { c.lower.denominator = 0; });
    refused("no time", [](auto& c) { c.upper.denominator = 0; });
    refused("a time before 0", [](auto& c) { c.lower.numerator = -1; });
    if (proof.answer == CastAnswer::hit) {
      refused("a miss", [](auto& c) { c.answer = CastAnswer::miss; });
      refused("no body", [](auto& c) { c.body = 1; });
      refused("no part", [](auto& c) { c.part = 1000; });
      if (proof.upper.numerator == 0) continue;
      refused("later", [](auto& c) {
        c.lower = {c.upper.numerator * 1001, c.upper.denominator * 1000};
      });
      refused("before", [](auto& c) {
        c.upper = {c.upper.numerator * 3, c.upper.denominator * 4};
      });
      refused("beyond the end", [&](auto& c) { c.t_max = value_of(c.upper) * 0.999; });
      if (proof.lower.numerator > 0) refused("any", [](auto& c) { c.is_first = false; });
    }
    if (proof.answer == CastAnswer::miss) {
      refused("a hit", [](auto& c) { c.answer = CastAnswer::hit; });
      refused("a time of a miss", [](auto& c) { c.lower.numerator = 1; });
      refused("a part of a miss", [](auto& c) { c.part = 1; });
      refused("a body of a miss", [](auto& c) { c.body = 1; });
    }
    if (proof.cover.steps.empty()) continue;
    refused("no body is covered", [](auto& c) { c.cover = {}; });
    refused("the body is halved", [](auto& c) { c.cover.steps[0].kind = RayKind::halve; });
    refused("the body is a triangle", [](auto& c) { c.cover.steps[0].kind = RayKind::triangle; });
    refused("a body's cover too much", [](auto& c) { c.of_bodies.emplace_back(); });
    if (proof.of_bodies.empty()) continue;
    refused("a body has no cover", [](auto& c) { c.of_bodies.clear(); });
    refused("a part is missing", [](auto& c) { c.of_bodies[0].order.pop_back(); });
    refused("a part is there twice", [](auto& c) { c.of_bodies[0].order.push_back(0); });
    refused("a part is none", [](auto& c) { c.of_bodies[0].order[0] = 1000; });
    refused("a cover too long", [](auto& c) { c.of_bodies[0].steps.push_back({}); });
    const auto& steps = proof.of_bodies[0].steps;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      refused("a step is missing", [&](auto& c) {
        c.of_bodies[0].steps.erase(c.of_bodies[0].steps.begin() + static_cast<std::ptrdiff_t>(k));
      });
      refused("no step", [&](auto& c) { c.of_bodies[0].steps[k].kind = static_cast<RayKind>(9); });
      if (steps[k].kind != RayKind::own_plane) {
        refused("another step",
                [&](auto& c) { c.of_bodies[0].steps[k].kind = RayKind::own_plane; });
      }
      if (steps[k].kind != RayKind::plane) continue;
      refused("no direction", [&](auto& c) { c.of_bodies[0].steps[k].direction = {}; });
      refused("the other way", [&](auto& c) {
        for (auto& x : c.of_bodies[0].steps[k].direction) x = -x;
      });
    }
  }
  EXPECT_GT(changes, 500);
}

// Whatever is changed in a certificate: if it is verified, what it claims is true.
TEST(BodyRayCertificates, WhatIsVerifiedIsTrue) {
  reference::Random random(12);
  int verified = 0, refused = 0;
  for (int i = 0; i < drawn(60, 8); ++i) {
    const ConcaveBody body = i % 2 == 0 ? body_of(families::torus(7, 5, 1, 0.5))
                                        : reference::compound(random, 3, i % 4 == 1, false);
    const Pose pose{random.rotation(), random.vector(1)};
    CheckedScene checked({{body, pose}});
    SceneRayProver prover({{body, pose}});
    const Vec3d origin = 4 * random.direction();
    const Vec3d direction = random.vector(1.5) - origin;
    const auto proof = *prover.prove(origin, direction, no_end, true);
    const auto other = *prover.prove(origin, direction + random.vector(1), no_end, true);
    for (int k = 0; k < 60; ++k) {
      SceneRayCertificate c = proof;
      for (int n = 0; n <= k % 2; ++n) {
        switch (random.below(9)) {
          case 0: c.answer = static_cast<CastAnswer>(random.below(3)); break;
          case 1: c.lower.numerator *= random.below(3); break;
          case 2:
            c.upper = {c.upper.numerator * (900 + random.below(200)), c.upper.denominator * 1000};
            break;
          case 3:
            c.part = static_cast<std::uint32_t>(random.below(static_cast<int>(body.part_count())));
            break;
          case 4:
            c.cover = other.cover;
            c.of_bodies = other.of_bodies;
            break;
          case 5: c.is_first = !c.is_first; break;
          case 6: c.t_max = random.uniform(0, 2); break;
          case 7: c.direction = other.direction; break;
          default:
            c.lower = other.lower;
            c.upper = other.upper;
            c.part = other.part;
            break;
        }
      }
      const bool holds = checked.fault(c).empty();
      ++(holds ? verified : refused);
      if (!holds || c.answer == CastAnswer::unknown) continue;
      expect_true({{body, pose}}, c);
    }
  }
  EXPECT_GT(verified, 200 / one_in);
  EXPECT_GT(refused, 1000 / one_in);
}

TEST(BodyRayCertificates, EndsEmptyBodiesAndImproperRays) {
  const ConcaveBody ball = body_of(reference::make_sphere(1)), empty{};
  RayCounts counts;
  expect_ray_proven(empty, {}, {{0, 0, 3}, {0, 0, -1}, no_end}, "empty", counts);
  expect_ray_proven(ball, {}, {{0, 0, 3}, {0, 0, -1}, -1}, "nothing of it", counts);
  expect_ray_proven(ball, {}, {{0, 0, 3}, {0, 0, -1}, 1.75}, "too short", counts);
  EXPECT_EQ(counts.misses, 6);
  expect_ray_proven(ball, {}, {{0, 0, 0.5}, {0, 0, -1}, 0}, "from inside", counts);
  expect_ray_proven(ball, {}, {{0, 0, 3}, {0, 0, -1}, 2}, "to the end", counts);
  expect_ray_proven(ball, {}, {{1, 0, 3}, {0, 0, -1}, no_end}, "tangent", counts);
  EXPECT_EQ(counts.hits, 6);
  EXPECT_EQ(counts.unknown, 0);
  SceneRayProver prover({{ball, {}}});
  EXPECT_FALSE(prover.prove({0, 0, 3}, {0, 0, 0}, no_end, true));
  EXPECT_FALSE(prover.prove({0, 0, no_end}, {0, 0, 1}, no_end, true));
  EXPECT_FALSE(prover.prove({0, 0, 3}, {0, 0, 1}, std::nan(""), true));
  ConcaveBody rounded = ball;
  rounded.parts[0].rounding = 1e-300;
  EXPECT_FALSE(SceneRayProver({{rounded, {}}}).prove({0, 0, 3}, {0, 0, 1}, no_end, true));
  const auto proof = prover.prove({0, 0, 3}, {0, 0, 1}, no_end, true);
  EXPECT_NE(CheckedScene({{rounded, {}}}).fault(*proof), "");
}

TEST(BodyRayCertificates, OfMissesWithoutEndAreProvenWhateverTheLengthOfTheDirection) {
  for (const Shape& shape : reference::shapes_of_all_kinds()) {
    if (shape.kind == ShapeKind::halfspace) continue;
    const ConcaveBody body = body_of(shape);
    SceneRayProver prover({{body, Pose{}}});
    CheckedScene checked({{body, Pose{}}});
    for (const int power : {-1000, -600, -100, 0, 100, 600, 1000}) {
      const Vec3d way = std::ldexp(1.0, power) * Vec3d(1, 0.25, -0.5);
      const auto proof = prover.prove({-4, 3, 1}, way, no_end, true);
      ASSERT_TRUE(proof);
      EXPECT_EQ(proof->answer, CastAnswer::miss) << to_string(shape.kind) << ' ' << power;
      EXPECT_EQ(checked.fault(*proof), "");
    }
  }
}

}  // namespace
}  // namespace touchstone
