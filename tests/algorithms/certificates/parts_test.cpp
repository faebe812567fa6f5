// Exact answers about bodies of many parts are proven.
#include <gtest/gtest.h>

#include <cmath>
#include <exception>
#include <string>
#include <vector>

#include "tests/algorithms/certificates/proven_pairs.h"

namespace touchstone {
namespace {

using reference::all_claims;
using reference::body_of;
using reference::expect_proven;
using reference::moved_by;
using reference::PartsCertificate;
using reference::PartsClaim;
using reference::ProofCounts;
using reference::ProvenPair;

TEST(PartsCertificates, MeshesOfAllFamilies) {
  reference::Random random(11);
  std::vector<ConcaveBody> bodies = {body_of(families::torus(12, 8, 1, 0.5, true)),
                                     body_of(families::torus(9, 7, 0.5, 0.125)),
                                     body_of(families::box_mesh(0.125, 0.25, 0.125, true)),
                                     body_of(families::terrain_mesh(4, 1, 3)),
                                     body_of(families::soup_mesh(60, 5)),
                                     body_of(TriangleMesh{})};
  for (auto& [name, mesh] : families::closed_meshes()) {
    mesh.solid = true;
    if (mesh.triangles.size() < 400) bodies.push_back(body_of(mesh));
  }
  ProofCounts counts;
  for (int i = 0; i < drawn(90, 8); ++i) {
    const auto any_of_them = [&] {
      return bodies[static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())))];
    };
    ProvenPair pair{any_of_them(), any_of_them(), {}, {}};
    pair.pose_a = {random.rotation(), random.vector(1)};
    pair.pose_b = {random.rotation(), random.vector(2)};
    if (i % 5 == 0) pair.pose_b.rotation.col(2) *= -0.5;
    expect_proven(pair, "pair " + std::to_string(i), counts);
  }
  EXPECT_EQ(counts.unknown, 0);
  EXPECT_GT(counts.separated, 30 / one_in);
  EXPECT_GT(counts.overlapping, 60 / one_in);
  EXPECT_GT(counts.met, 100 / one_in);
}

// On grids, so that faces, edges and corners touch exactly.
TEST(PartsCertificates, MeshesThatTouch) {
  reference::Random random(4);
  ProofCounts counts;
  const int pairs = drawn(60, 20);
  for (int i = 0; i < pairs; ++i) {
    const bool solid = i % 2 == 0;
    ProvenPair pair{body_of(families::box_mesh(1, 1, 1, solid)),
                    body_of(families::box_mesh(0.25, 0.5, 0.25, random.below(2) == 0)),
                    {},
                    {}};
    for (int k = 0; k < 3; ++k) pair.pose_b.translation[k] = 0.25 * (random.below(13) - 6);
    if (i % 3 == 0) pair.pose_b.translation[0] = 1.25;
    if (i % 5 == 0) pair.pose_b.translation.setZero();
    if (i % 7 == 0) pair.pose_b.translation[1] = 2;
    expect_proven(pair, "touch " + std::to_string(i), counts);
  }
  EXPECT_EQ(counts.unknown, 0);
  EXPECT_GT(counts.separated, pairs / 4);
  EXPECT_GT(counts.overlapping, pairs);
  EXPECT_GT(counts.inside, pairs / 10);
}

TEST(PartsCertificates, CompoundsOfAllKinds) {
  reference::Random random(6);
  ProofCounts counts;
  const int pairs = drawn(80, 24);
  for (int i = 0; i < pairs; ++i) {
    ProvenPair pair{reference::compound(random, 1 + random.below(5), i % 6 == 0, i % 3 == 0),
                    reference::compound(random, 1 + random.below(5), i % 7 == 0, i % 4 == 0),
                    {random.rotation(), random.vector(1)},
                    {random.rotation(), random.vector(i % 2 == 0 ? 6 : 3)}};
    if (i % 5 == 0) pair.pose_a.rotation *= 1.25;
    expect_proven(pair, "compound " + std::to_string(i), counts, true);
  }
  EXPECT_GT(counts.separated, pairs / 4);
  EXPECT_GT(counts.overlapping, pairs / 4);
}

TEST(PartsCertificates, BodiesInsideOfSolids) {
  const ConcaveBody solid = body_of(families::box_mesh(2, 2, 2, true));
  const ConcaveBody hollow = body_of(families::box_mesh(2, 2, 2));
  reference::Random random(9);
  ProofCounts counts, none;
  for (int i = 0; i < 8; ++i) {
    const ConcaveBody small =
        i < 4 ? body_of(reference::shapes_of_all_kinds()[static_cast<std::size_t>(i)],
                        {random.rotation(), random.vector(0.5)})
              : body_of(families::torus(6, 5, 0.5, 0.25, i % 2 == 0));
    const Pose pose = moved_by(random.vector(0.25)), turned = {random.rotation(), Vec3d::Zero()};
    expect_proven({solid, small, turned, pose}, "inside", counts);
    expect_proven({small, solid, pose, turned}, "around", counts);
    expect_proven({hollow, small, turned, pose}, "hollow", none);
  }
  EXPECT_EQ(counts.inside, 48);
  EXPECT_EQ(none.inside, 0);
  EXPECT_EQ(none.separated, 24);
  // A solid among the parts of a compound, under two matrices that turn and stretch.
  ConcaveBody compound = body_of(reference::make_sphere(0.25), moved_by({9, 0, 0}));
  Pose stretched{random.rotation(), Vec3d(0.5, 0, 0)};
  stretched.rotation.col(0) *= 3;
  reference::add_surface(compound, families::box_mesh(2, 2, 2, true), stretched);
  ProofCounts within;
  expect_proven(
      {compound, body_of(reference::make_sphere(0.25)), {random.rotation(), Vec3d::Zero()}, {}},
      "compound", within);
  EXPECT_EQ(within.inside, 3);
}

TEST(PartsCertificates, EmptyBodies) {
  ProofCounts counts;
  const ConcaveBody empty = body_of(TriangleMesh{}), nothing{};
  expect_proven({empty, body_of(families::box_mesh(1, 1, 1, true)), {}, {}}, "empty", counts);
  expect_proven({body_of(reference::make_halfspace({0, 0, 1}, 0)), nothing, {}, {}}, "half",
                counts);
  expect_proven({empty, nothing, {}, {}}, "both", counts);
  EXPECT_EQ(counts.separated, 9);
}

// Nobody makes such bodies of files; whoever does otherwise is told.
TEST(PartsCertificates, BodiesThatAreNoneEndInAnErrorThatSaysWhy) {
  const ConcaveBody good = body_of(families::box_mesh(1, 1, 1));
  const auto reason = [&](const ConcaveBody& bad) -> std::string {
    try {
      ProvenPair{good, bad, {}, {}}.prove(PartsClaim::intersect);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  };
  TriangleMesh mesh = families::box_mesh(1, 1, 1);
  mesh.triangles[3][1] = 8;
  EXPECT_EQ(reason(body_of(mesh)), "a triangle of the mesh names no vertex");
  mesh = families::box_mesh(1, 1, 1);
  mesh.vertices[7].x() = std::nan("");
  EXPECT_EQ(reason(body_of(mesh)), "a number of a body or of a generator is not finite");
  EXPECT_EQ(reason(body_of(reference::make_sphere(-1))), "a radius is negative");
}

TEST(PartsCertificates, CurvedPartsThatTouchAreOpen) {
  // They meet at a point whose coordinates are thirds.
  ConcaveBody a = body_of(reference::make_ellipsoid(1, 1, 1));
  a.parts.push_back({reference::make_sphere(1), moved_by({20, 0, 0}), 0});
  const ProvenPair pair{a, body_of(reference::make_ellipsoid(2, 2, 2)), {}, moved_by({2, 2, 1})};
  for (const PartsClaim claim : all_claims) {
    const PartsCertificate proof = pair.prove(claim);
    EXPECT_EQ(pair.fault(proof), "");
    EXPECT_EQ(proof.answer, pair.solve(claim).outcome.answer);
    EXPECT_EQ(proof.undecided, 1u);
  }
}

// Two meshes of thousands of triangles have a cover that is not quadratic.
TEST(PartsCertificates, LargeMeshes) {
  ProvenPair pair{body_of(families::torus(60, 40, 2, 0.75, true)),
                  body_of(families::torus(60, 40, 2, 0.5)),
                  {},
                  moved_by({0, 0, 1.5})};
  if (one_in > 1) {
    pair.a = body_of(families::torus(20, 10, 2, 0.75, true));
    pair.b = body_of(families::torus(20, 20, 2, 0.5));
  }
  const std::size_t pairs = std::size_t{pair.a.part_count()} * pair.b.part_count();
  for (const PartsClaim claim : all_claims) {
    if (one_in > 1 && claim == PartsClaim::contacts) continue;  // as intersect
    const PartsCertificate proof = pair.prove(claim);
    EXPECT_EQ(pair.fault(proof), "");
    EXPECT_EQ(proof.answer, Answer::separated);
    EXPECT_LT(proof.cover.size(), pairs / 20);
  }
}

}  // namespace
}  // namespace touchstone
