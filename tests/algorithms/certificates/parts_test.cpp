// Exact answers about bodies of many parts are proven.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algorithms/core/mesh/common_frame.h"
#include "harness/geometry/shapes/compound.h"
#include "tests/algorithms/certificates/bodies.h"

namespace touchstone {
namespace {

using reference::all_claims;
using reference::body_of;
using reference::moved_by;
using reference::PartsCertificate;
using reference::PartsClaim;
using reference::ProvenPair;

struct Counts {
  int separated = 0, overlapping = 0, unknown = 0, inside = 0, met = 0;
};

// What is proven is what the solver says, whose answers are known unless `may_be_unknown`.
void expect_proven(const ProvenPair& pair, const std::string& what, Counts& counts,
                   bool may_be_unknown = false) {
  for (const PartsClaim claim : all_claims) {
    const PartsCertificate proof = pair.prove(claim);
    const reference::Answered solved = pair.solve(claim);
    EXPECT_EQ(pair.fault(proof), "") << what;
    if (!may_be_unknown || proof.answer == Answer::unknown) {
      EXPECT_EQ(proof.answer, solved.outcome.answer) << what;
    } else if (solved.outcome.answer != Answer::unknown) {
      EXPECT_EQ(proof.answer, solved.outcome.answer) << what;
    }
    if (claim == PartsClaim::contacts && proof.undecided == 0) {
      EXPECT_EQ(reference::met_pairs(proof), solved.pairs) << what;
      counts.met += static_cast<int>(solved.pairs.size());
    }
    if (proof.bounds && solved.outcome.answer == Answer::separated) {
      EXPECT_EQ(proof.bounds->lower, std::max(0.0, solved.outcome.lower)) << what;
      EXPECT_LE(proof.bounds->upper, solved.outcome.upper * (1 + 1e-12)) << what;
    }
    counts.inside += proof.inside ? 1 : 0;
    if (proof.answer == Answer::separated) ++counts.separated;
    if (proof.answer == Answer::overlapping) ++counts.overlapping;
    if (proof.answer == Answer::unknown) ++counts.unknown;
  }
}

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
  Counts counts;
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
  Counts counts;
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
  Counts counts;
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

// The plane of a half-space under the product of two matrices, neither of them a rotation.
TEST(PartsCertificates, HalfSpacesUnderShears) {
  reference::Random random(8);
  Counts counts;
  for (int i = 0; i < 80; ++i) {
    ConcaveBody ground, ball;
    Pose sheared{random.rotation(), random.vector(1)};
    sheared.rotation.col(0) += 0.5 * sheared.rotation.col(1);
    sheared.rotation.col(2) *= i % 3 == 0 ? -0.5 : 3.0;
    ground.parts = {{reference::make_halfspace({1, 2, -0.5}, 0.25), sheared, 0}};
    const auto shapes = reference::shapes_of_all_kinds();
    ball.parts = {
        {shapes[static_cast<std::size_t>(i % 8)], {random.rotation(), random.vector(1)}, 0},
        {shapes[static_cast<std::size_t>(random.below(8))],
         {random.rotation(), random.vector(1)},
         0}};
    ProvenPair pair{
        ground, ball, {random.rotation(), random.vector(2)}, {random.rotation(), random.vector(4)}};
    pair.pose_a.rotation.col(1) *= 0.75;
    if (i % 2 == 0) {
      std::swap(pair.a, pair.b);
      std::swap(pair.pose_a, pair.pose_b);
    }
    expect_proven(pair, "half-space " + std::to_string(i), counts, true);
  }
  EXPECT_LT(counts.unknown, 20);
  EXPECT_GT(counts.separated, 30);
  EXPECT_GT(counts.overlapping, 60);
}

TEST(PartsCertificates, TwoHalfSpaces) {
  const auto below = body_of(reference::make_halfspace({0, 0, 2}, -1), moved_by({0, 0, 0.25}));
  const auto above = body_of(reference::make_halfspace({0, 0, -3}, -3));
  Counts counts;
  expect_proven({below, above, {}, {}}, "apart", counts);
  EXPECT_EQ(counts.separated, 3);
  expect_proven({below, above, {}, moved_by({5, 0, -1.25})}, "touching", counts);
  Pose turned;
  turned.rotation = Eigen::AngleAxisd(1e-9, Vec3d::UnitX()).toRotationMatrix();
  expect_proven({below, above, {}, turned}, "turned", counts);
  expect_proven({below, below, {}, {}}, "the same", counts);
  EXPECT_EQ(counts.overlapping, 9);
  // One without an inverse has no answer.
  Pose flat;
  flat.rotation.col(2).setZero();
  const ProvenPair singular{below, above, flat, {}};
  for (const PartsClaim claim : all_claims) {
    const PartsCertificate proof = singular.prove(claim);
    EXPECT_EQ(singular.fault(proof), "");
    EXPECT_EQ(proof.answer, Answer::unknown);
  }
}

TEST(PartsCertificates, BodiesInsideOfSolids) {
  const ConcaveBody solid = body_of(families::box_mesh(2, 2, 2, true));
  const ConcaveBody hollow = body_of(families::box_mesh(2, 2, 2));
  reference::Random random(9);
  Counts counts, none;
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
  Counts within;
  expect_proven(
      {compound, body_of(reference::make_sphere(0.25)), {random.rotation(), Vec3d::Zero()}, {}},
      "compound", within);
  EXPECT_EQ(within.inside, 3);
}

TEST(PartsCertificates, EmptyBodies) {
  Counts counts;
  const ConcaveBody empty = body_of(TriangleMesh{}), nothing{};
  expect_proven({empty, body_of(families::box_mesh(1, 1, 1, true)), {}, {}}, "empty", counts);
  expect_proven({body_of(reference::make_halfspace({0, 0, 1}, 0)), nothing, {}, {}}, "half",
                counts);
  expect_proven({empty, nothing, {}, {}}, "both", counts);
  EXPECT_EQ(counts.separated, 9);
}

// Products of the poses underflow, overflow the digits of doubles, or are denormal.
TEST(PartsCertificates, PosesWhoseProductsAreNoDoubles) {
  Counts counts;
  for (const double scale : {1e-200, 1e-170, 0x1p-540, 1e-100, 1e100, 0x1.fffffffffffffp0}) {
    Pose outer, inner;
    outer.rotation *= scale;
    inner.rotation *= scale;
    inner.translation = {scale, 0, 0};
    for (const double gap : {-0.5, 0.0, 0.5}) {
      ConcaveBody a = body_of(reference::make_box(1, 1, 1), inner);
      ConcaveBody b = body_of(reference::make_box(1, 1, 1), inner);
      const ProvenPair pair{a, b, outer, {outer.rotation, {scale * (2 + gap) * scale, 0, 0}}};
      for (const PartsClaim claim : all_claims) {
        const PartsCertificate proof = pair.prove(claim);
        EXPECT_EQ(pair.fault(proof), "") << scale << " " << gap;
        if (proof.answer == Answer::separated) ++counts.separated;
        if (proof.answer == Answer::overlapping) ++counts.overlapping;
      }
    }
  }
  EXPECT_GT(counts.separated, 6);
  EXPECT_GT(counts.overlapping, 6);
}

// The boxes are apart, and all products of their poses are 0 in doubles, as if both were one point.
TEST(PartsCertificates, ProductsThatUnderflowAreNotExact) {
  Pose outer, left, right;
  outer.rotation *= 1e-170;
  left.rotation *= 1e-170;
  right = left;
  left.translation = {-1e-169, 0, 0};
  right.translation = {1e-169, 0, 0};
  EXPECT_GT(composed(outer, left, 1).error, 0);
  EXPECT_GT(composed(outer, left, 1e300).error, 1e-10);
  EXPECT_EQ(composed({}, left, 1).error, 0);
  const Shape box = reference::make_box(1, 1, 1);
  const ProvenPair pair{body_of(box, left), body_of(box, right), outer, outer};
  const ProvenPair same{body_of(box, left), body_of(box, left), outer, outer};
  for (const PartsClaim claim : all_claims) {
    for (const ProvenPair* each : {&pair, &same}) {
      EXPECT_EQ(each->solve(claim).outcome.answer, Answer::unknown);
      EXPECT_EQ(each->fault(each->prove(claim)), "");
    }
    EXPECT_NE(pair.prove(claim).answer, Answer::overlapping);
    EXPECT_NE(same.prove(claim).answer, Answer::separated);
  }
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

TEST(PartsCertificates, RoundedPlacesProveNothing) {
  ProvenPair pair{body_of(reference::make_sphere(1)),
                  body_of(reference::make_sphere(1)),
                  {},
                  moved_by({5, 0, 0})};
  const PartsCertificate proof = pair.prove(PartsClaim::intersect);
  EXPECT_EQ(pair.fault(proof), "");
  pair.a.parts[0].rounding = 1e-300;
  EXPECT_NE(pair.fault(proof), "");
  const PartsCertificate unknown = pair.prove(PartsClaim::intersect);
  EXPECT_EQ(pair.fault(unknown), "");
  EXPECT_EQ(unknown.answer, Answer::unknown);
}

// Compounds within compounds are where the product of all their poses puts them, whatever doubles make of it.
TEST(PartsCertificates, PosesWithinPosesAreMultipliedExactly) {
  reference::Random random(2);
  Counts counts;
  for (int i = 0; i < drawn(60, 8); ++i) {
    const std::vector<Pose> around = {{random.rotation(), random.vector(1)},
                                      {random.rotation(), random.vector(1)}};
    ConcaveBody nested;
    const auto shapes = reference::shapes_of_all_kinds();
    for (int k = 0; k < 2; ++k) {
      ConvexPart part{shapes[static_cast<std::size_t>((i + 3 * k) % 8)],
                      {random.rotation(), random.vector(1)}};
      geometry::place_within(around, part);
      ASSERT_GT(part.rounding, 0);
      ASSERT_TRUE(part.poses);
      EXPECT_EQ(part.poses->size(), 3u);
      nested.parts.push_back(part);
    }
    geometry::add_surface(std::make_shared<const TriangleMesh>(families::box_mesh(0.5, 1, 1, true)),
                          {random.rotation(), random.vector(1)}, around, nested);
    const ProvenPair pair{nested,
                          reference::compound(random, 2, false, i % 2 == 0),
                          {random.rotation(), Vec3d::Zero()},
                          {random.rotation(), random.vector(4)}};
    expect_proven(pair, "nested " + std::to_string(i), counts, true);
    // What is proven is of the exact product: the rounded one is another body.
    ConcaveBody rounded = nested;
    for (ConvexPart& part : rounded.parts) part.poses = nullptr;
    const PartsCertificate proof = pair.prove(PartsClaim::intersect);
    if (proof.answer != Answer::unknown) {
      EXPECT_NE((ProvenPair{rounded, pair.b, pair.pose_a, pair.pose_b}.fault(proof)), "");
    }
  }
  EXPECT_GT(counts.separated, 20 / one_in);
  EXPECT_GT(counts.overlapping, 20 / one_in);
  EXPECT_LT(counts.unknown, 10);
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

// The oracle is not asked about poses whose products are beyond doubles; half-spaces do not need it.
TEST(PartsCertificates, PosesWhoseProductsAreBeyondDoublesEndWithoutAnAnswer) {
  const double great = 1e200;
  const Pose huge{Mat3d(Mat3d::Identity() * great), Vec3d(-great, 0, 0)};
  for (const Shape& shape : reference::shapes_of_all_kinds()) {
    for (const Shape& other : {reference::make_sphere(1), reference::make_cone(1, 1)}) {
      const ProvenPair pair = {body_of(shape, huge), body_of(other), huge, moved_by({0, 0, 5})};
      for (const PartsClaim claim : reference::all_claims) {
        const PartsCertificate proof = pair.prove(claim);
        EXPECT_EQ(pair.fault(proof), "");
        if (shape.kind == ShapeKind::halfspace && claim != PartsClaim::distance) {
          EXPECT_EQ(proof.answer, Answer::separated);
        } else {
          EXPECT_EQ(proof.answer, Answer::unknown);
          EXPECT_EQ(pair.solve(claim).outcome.answer, Answer::unknown);
        }
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
