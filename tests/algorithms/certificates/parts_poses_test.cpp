// Exact answers are proven of parts where their exact poses put them, whatever doubles make of these.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "algorithms/core/mesh/common_frame.h"
#include "harness/geometry/concave_bodies.h"
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

// The plane of a half-space under the product of two matrices, neither of them a rotation.
TEST(PartsCertificates, HalfSpacesUnderShears) {
  reference::Random random(8);
  ProofCounts counts;
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
  ProofCounts counts;
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

// Products of the poses underflow, overflow the digits of doubles, or are denormal.
TEST(PartsCertificates, PosesWhoseProductsAreNoDoubles) {
  ProofCounts counts;
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
  ProofCounts counts;
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
