// The plane across the line of centres parts only bodies that are apart, and its corners are furthest.
#include "algorithms/kernels/gjk/first_plane.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/core/isa.h"
#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/kernels/gjk/placed_pair.h"
#include "tests/algorithms/one_in.h"

namespace touchstone::first_plane_test {
namespace {

using namespace reference;

Shape hull(Random& random, double size) {
  return hull_somewhere(random, size, 5 + random.below(40));
}

// Two bodies that are apart by `share` of the size of b, or overlap by it.
PlacedPair pair_at(Random& random, double size, double share, oracle::Oracle& oracle) {
  const double other = size * std::pow(10, random.uniform(-1, 0));
  PlacedPair pair{
      random.below(3) == 0 ? make_box(size, 0.5 * size, 0.2 * size) : hull(random, size),
      hull(random, other)};
  pair.place(random, size, share * other, oracle);
  return pair;
}

template <class Scalar>
FirstPlane plane_of(const PlacedPair& pair) {
  const SupportShape<Scalar> a(pair.a), b(pair.b);
  return first_plane(centre_offset(a, pair.pose_a, b, pair.pose_b), a, pair.pose_a, b, pair.pose_b);
}

TEST(FirstPlane, PartsOnlyWhatIsApart) {
  Random random(7);
  oracle::Oracle oracle;
  int parted = 0, open = 0, met = 0;
  for (int n = 0; n < drawn(1500, 300); ++n) {
    const double size = std::pow(10, random.uniform(-6, 6));
    const double near = std::pow(10, random.uniform(-5, 0.5));
    const PlacedPair pair = pair_at(random, size, random.below(3) == 0 ? -near : near, oracle);
    const bool apart = pair.measure(oracle).lower > 0;
    for (const Isa level : isa_levels()) {
      limit_isa(level);
      for (const bool parts : {plane_of<float>(pair).parts, plane_of<double>(pair).parts}) {
        EXPECT_TRUE(apart || !parts) << n << " at " << to_string(level);
        ++(parts ? parted : apart ? open : met);
      }
    }
    limit_isa(isa_of_machine());
  }
  const int all = drawn(1500, 300);
  EXPECT_GT(parted, all / 2);
  EXPECT_GT(open, all / 2);
  EXPECT_GT(met, all / 2);
}

// Where products overflow, no sum of them is believed.
TEST(FirstPlane, IsSilentWhereProductsOverflow) {
  std::vector<Vec3d> octahedron;
  for (int k = 0; k < 3; ++k) {
    octahedron.push_back(0.9e154 * Vec3d::Unit(k));
    octahedron.push_back(-0.9e154 * Vec3d::Unit(k));
  }
  PlacedPair pair{make_hull(octahedron), make_hull(octahedron)};
  pair.pose_b.translation = {1.5e154, 0, 0};
  EXPECT_FALSE(plane_of<double>(pair).parts);

  // No vertex of a has only positive coordinates, nor has one of b only negative ones.
  std::vector<Vec3d> of_a, of_b;
  for (const Vec3d& v : {Vec3d{-1, -0.8, -0.6}, Vec3d{1, 1, -0.01}, Vec3d{1, -0.01, 1},
                         Vec3d{-0.01, 1, 1}, Vec3d{-0.6, -1, -0.8}, Vec3d{-0.8, -0.6, -1}}) {
    of_a.push_back(1e39 * v);
    of_b.push_back(-1e39 * v);
  }
  pair = {make_hull(of_a), make_hull(of_b)};
  pair.pose_b.translation = Vec3d::Constant(1.25e39);
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    EXPECT_FALSE(plane_of<float>(pair).parts) << to_string(level);
  }
  limit_isa(isa_of_machine());
}

// Vertices of a hull, or corners of a box as its sign bits number them.
Vec3d corner(const Shape& shape, std::uint32_t number) {
  if (shape.kind != ShapeKind::box) return shape.hull->vertices[number];
  Vec3d at = shape.half_extents;
  for (int k = 0; k < 3; ++k) {
    if ((number >> k & 1) != 0) at[k] = -at[k];
  }
  return at;
}

TEST(FirstPlane, KeepsTheCornersThatAreFurthest) {
  Random random(8);
  oracle::Oracle oracle;
  int of_boxes = 0, of_hulls = 0;
  for (int n = 0; n < drawn(400, 100); ++n) {
    const PlacedPair pair = pair_at(random, 1, random.uniform(-0.3, 0.3), oracle);
    const SupportShape<double> a(pair.a), b(pair.b);
    const CentreOffset offset = centre_offset(a, pair.pose_a, b, pair.pose_b);
    const FirstPlane plane = first_plane(offset, a, pair.pose_a, b, pair.pose_b);
    const auto along = [&](const Shape& shape, const Pose& pose, std::uint32_t number) {
      return offset.vector.dot(pose.rotation * corner(shape, number));
    };
    const auto corners = [](const Shape& shape) {
      return shape.kind == ShapeKind::box ? std::size_t{8} : shape.hull->vertices.size();
    };
    for (std::uint32_t i = 0; i < corners(pair.a); ++i) {
      EXPECT_LE(along(pair.a, pair.pose_a, i), along(pair.a, pair.pose_a, plane.corners.a) + 1e-12);
    }
    for (std::uint32_t i = 0; i < corners(pair.b); ++i) {
      EXPECT_GE(along(pair.b, pair.pose_b, i), along(pair.b, pair.pose_b, plane.corners.b) - 1e-12);
    }
    ++(pair.a.kind == ShapeKind::box ? of_boxes : of_hulls);
  }
  EXPECT_GT(of_boxes, 10);
  EXPECT_GT(of_hulls, 10);
}

// Beyond the range of the numbers, and with matrices that are none of a body, it proves nothing.
TEST(FirstPlane, IsSilentWhereItsBoundsDoNotHold) {
  Random random(9);
  const auto at = [&](double size, double distance) {
    PlacedPair pair{hull(random, size), hull(random, size)};
    pair.pose_b.translation = {distance, 0, 0};
    return pair;
  };
  EXPECT_TRUE(plane_of<double>(at(1, 20)).parts);
  EXPECT_TRUE(plane_of<float>(at(1, 20)).parts);
  for (const double size : {1e-200, 1e-160, 1e160, 1e200}) {
    EXPECT_FALSE(plane_of<double>(at(size, 20 * size)).parts) << size;
  }
  for (const double size : {1e-44, 1e-33}) {
    EXPECT_FALSE(plane_of<float>(at(size, 20 * size)).parts) << size;
  }
  for (const double entry :
       {1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    PlacedPair pair = at(1, 20);
    pair.pose_a.rotation(1, 2) = entry;
    EXPECT_FALSE(plane_of<double>(pair).parts) << entry;
    pair = at(1, 20);
    pair.pose_b.rotation(0, 0) = entry;
    EXPECT_FALSE(plane_of<float>(pair).parts) << entry;
    pair = at(1, 20);
    pair.pose_b.translation.z() = entry;
    EXPECT_EQ(plane_of<double>(pair).parts, entry == 1e9);
  }
}

}  // namespace
}  // namespace touchstone::first_plane_test
