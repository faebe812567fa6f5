// Answers to rays and points at meshes are proven for all families, and no changed claim is.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/rays/exact_mesh_proofs.h"
#include "harness/families/aimed_queries.h"
#include "harness/families/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using oracle::CheckedMesh;
using oracle::MeshProver;
using oracle::no_triangle;
using oracle::PointCertificate;
using oracle::RayCertificate;
using Claim = PointCertificate::Claim;

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(RayCertificates, ProveEveryAnswerOfAllFamilies) {
  int hits = 0, misses = 0;
  for (const auto& [name, mesh] : families::ray_meshes()) {
    const CheckedMesh checked(mesh);
    MeshProver prover(mesh);
    reference::Random random(5);
    for (const Ray& ray : families::aimed_rays(mesh, 1, 7)) {
      if (random.below(6 * one_in) != 0) continue;
      for (const bool is_first : {true, false}) {
        const auto proof = prover.prove_ray(ray.origin, ray.direction, ray.t_max, is_first);
        ASSERT_TRUE(proof) << name;
        ++(proof->hit ? hits : misses);
        EXPECT_EQ(checked.fault(*proof), "") << name;
      }
    }
  }
  EXPECT_GT(hits, 200 / one_in);
  EXPECT_GT(misses, 200 / one_in);
}

TEST(RayCertificates, EveryChangedClaimIsRefused) {
  const TriangleMesh mesh = families::torus(9, 7, 2, 0.75);
  const CheckedMesh checked(mesh);
  MeshProver prover(mesh);
  reference::Random random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3d origin = random.vector(4), direction = random.vector(1);
    const RayCertificate proof = *prover.prove_ray(origin, direction, infinite, true);
    ++(proof.hit ? hits : misses);
    std::vector<RayCertificate> changed(12, proof);
    changed[0].hit = !proof.hit;
    if (!proof.hit) {
      changed[0].triangle = 0;
      changed[1].triangle = 0;
      changed[2].t.numerator = 1;
      changed[3].t.denominator = 2;
      // A ray that turns round, so that it hits, is no miss.
      changed.resize(4);
    } else {
      changed[0].triangle = no_triangle;
      changed[0].t = {};
      changed[1].triangle = (proof.triangle + 1) % 126;
      changed[2].t.numerator += 1;
      changed[3].t.denominator *= 2;
      changed[4].t.denominator = 0;
      changed[5].t = {-proof.t.numerator, -proof.t.denominator};
      changed[6].origin[0] += 1e-9;
      changed[7].direction *= 2;
      changed[8].t_max = proof.t.numerator.convert_to<double>() /
                         proof.t.denominator.convert_to<double>() * (1 - 1e-9);
      changed[9].triangle = 126;
      changed[10].direction.setZero();
      changed[11].t_max = std::nan("");
    }
    for (std::size_t k = 0; k < changed.size(); ++k) {
      EXPECT_NE(checked.fault(changed[k]), "") << k << " of " << i;
    }
  }
  EXPECT_GT(hits, 8);
  EXPECT_GT(misses, 8);
}

// The second of two triangles is hit too, and first only if its number is the lower one.
TEST(RayCertificates, TheFirstIsFirst) {
  TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {2, 0, 1}, {0, 2, 1}},
                    {{0, 1, 2}, {3, 4, 5}, {3, 5, 4}}};
  const CheckedMesh checked(mesh);
  RayCertificate hit{{0.5, 0.25, 3}, {0, 0, -1}, infinite, true, true, 1, {2, 1}};
  EXPECT_EQ(checked.fault(hit), "");
  hit.triangle = 2;
  EXPECT_EQ(checked.fault(hit), "a triangle with a lower number is hit then");
  hit.is_first = false;
  EXPECT_EQ(checked.fault(hit), "");
  hit.triangle = 0;
  hit.t = {3, 1};
  EXPECT_EQ(checked.fault(hit), "");
  hit.is_first = true;
  EXPECT_EQ(checked.fault(hit), "a triangle is hit before");
  hit.t_max = 2;
  EXPECT_EQ(checked.fault(hit), "the hit is beyond the end of the ray");
  // The ends of the ray belong to it.
  hit = {{0.5, 0.25, 3}, {0, 0, -1}, 2, true, true, 1, {2, 1}};
  EXPECT_EQ(checked.fault(hit), "");
  const RayCertificate miss{{0.5, 0.25, 3}, {0, 0, -1}, std::nextafter(2.0, 0.0), true, false,
                            no_triangle,    {}};
  EXPECT_EQ(checked.fault(miss), "");
  // There is nothing to hit before the ray begins, nor in no triangle.
  const RayCertificate nothing{{0, 0, 0}, {0, 0, 1}, -1, true, false, no_triangle, {}};
  EXPECT_EQ(checked.fault(nothing), "");
  const RayCertificate empty{{0, 0, 0}, {0, 0, 1}, infinite, true, false, no_triangle, {}};
  EXPECT_EQ(CheckedMesh(TriangleMesh{}).fault(empty), "");
  EXPECT_EQ(checked.fault(empty), "a triangle has a point of the ray");
  mesh.triangles.push_back({0, 1, 6});
  EXPECT_NE(CheckedMesh(mesh).fault(nothing), "");
}

// In the plane of a triangle, along an edge, at points and segments; at coordinates near both ends of doubles.
TEST(RayCertificates, DegenerateAndExtreme) {
  int hits = 0, misses = 0;
  for (const double size : {1.0, 1e-160, 1e-310, 1e150, 1e300}) {
    const TriangleMesh mesh{
        {Vec3d(0, 0, 0), size * Vec3d(1, 0, 0), size * Vec3d(0, 1, 0), size * Vec3d(0.5, 0, 0)},
        {{0, 3, 1}, {1, 1, 1}, {0, 1, 2}, {2, 2, 0}}};
    const CheckedMesh checked(mesh);
    MeshProver prover(mesh);
    reference::Random random(2);
    const std::array<double, 5> coordinates = {-1, 0, 0.25, 0.5, 1};
    for (int i = 0; i < 300; ++i) {
      Vec3d origin, direction;
      for (int k = 0; k < 3; ++k) {
        origin[k] = size * coordinates[static_cast<std::size_t>(random.below(5))];
        direction[k] = random.below(3) - 1;
      }
      if (i % 2 == 0) origin[2] = direction[2] = 0;
      const auto proof = prover.prove_ray(origin, direction, i % 3 == 0 ? size : infinite, true);
      EXPECT_EQ(proof.has_value(), !direction.isZero(0));
      if (!proof) continue;
      ++(proof->hit ? hits : misses);
      EXPECT_EQ(checked.fault(*proof), "") << size << " " << i;
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(misses, 200);
}

TEST(PointCertificates, ProveEveryAnswerOfAllFamilies) {
  std::array<int, 4> claims{};
  for (const auto& [name, mesh] : families::closed_meshes()) {
    const CheckedMesh checked(mesh);
    MeshProver prover(mesh);
    for (const Vec3d& point : families::tried_points(mesh, 0.03 / one_in, 3)) {
      for (const auto& proof : {prover.prove_nearest(point), prover.prove_side(point)}) {
        ASSERT_TRUE(proof) << name;
        ++claims[static_cast<std::size_t>(proof->claim)];
        EXPECT_EQ(checked.fault(*proof), "") << name << " " << point.transpose();
      }
    }
  }
  for (const int count : claims) EXPECT_GT(count, 5 / one_in);
}

TEST(PointCertificates, ProveTheNearestOfOpenMeshesToo) {
  for (const auto& [name, mesh] : families::ray_meshes()) {
    const CheckedMesh checked(mesh);
    MeshProver prover(mesh);
    for (const Vec3d& point : families::tried_points(mesh, 0.02 / one_in, 4)) {
      EXPECT_EQ(checked.fault(*prover.prove_nearest(point)), "") << name;
    }
  }
}

TEST(PointCertificates, EveryChangedClaimIsRefused) {
  const TriangleMesh mesh = families::torus(9, 7, 2, 0.75, true);
  const CheckedMesh checked(mesh);
  MeshProver prover(mesh);
  reference::Random random(3);
  std::array<int, 4> claims{};
  for (int i = 0; i < 120; ++i) {
    Vec3d point = random.vector(2.5);
    if (i % 4 == 0) point = mesh.vertices[static_cast<std::size_t>(random.below(63))];
    PointCertificate proof = *prover.prove_nearest(point);
    std::vector<PointCertificate> changed(7, proof);
    changed[0].triangle = (proof.triangle + 60) % 126;
    changed[1].square.numerator += 1;
    changed[2].square.denominator = 0;
    changed[3].triangle = no_triangle;
    changed[4].winding = 1;
    changed[5].triangle = 126;
    changed[6].point += 1e-9 * Vec3d(1, 2, 3);
    for (std::size_t k = 0; k < changed.size(); ++k) {
      EXPECT_NE(checked.fault(changed[k]), "") << k << " of " << i;
    }
    proof = *prover.prove_side(point);
    ++claims[static_cast<std::size_t>(proof.claim)];
    for (const Claim claim : {Claim::nearest, Claim::surface, Claim::inside, Claim::outside}) {
      if (claim == proof.claim) continue;
      PointCertificate one = proof;
      one.claim = claim;
      EXPECT_NE(checked.fault(one), "");
    }
    changed.assign(3, proof);
    changed[0].winding += 1;
    changed[1].triangle = 0;
    changed[2].square.numerator = 1;
    for (const PointCertificate& one : changed) EXPECT_NE(checked.fault(one), "");
  }
  for (std::size_t k = 1; k < 4; ++k) EXPECT_GT(claims[k], 5) << k;
}

TEST(PointCertificates, OpenSurfacesAndEmptyOnes) {
  TriangleMesh mesh = families::box_mesh(1, 1, 1);
  const PointCertificate inside{Vec3d::Zero(), Claim::inside, no_triangle, {}, 1};
  EXPECT_EQ(CheckedMesh(mesh).fault(inside), "");
  mesh.triangles.pop_back();
  EXPECT_EQ(CheckedMesh(mesh).fault(inside), "the surface is open");
  const CheckedMesh empty{TriangleMesh{}};
  EXPECT_EQ(empty.fault({Vec3d::Zero(), Claim::nearest, no_triangle, {}, 0}), "");
  EXPECT_EQ(empty.fault({Vec3d::Zero(), Claim::outside, no_triangle, {}, 0}), "");
  EXPECT_NE(empty.fault({Vec3d::Zero(), Claim::nearest, 0, {}, 0}), "");
  EXPECT_NE(empty.fault({Vec3d::Constant(infinite), Claim::outside, no_triangle, {}, 0}), "");
}

}  // namespace
}  // namespace touchstone
