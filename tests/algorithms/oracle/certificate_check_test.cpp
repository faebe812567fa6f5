#include "algorithms/oracle/certificates/certificate_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "tests/algorithms/shapes.h"

namespace touchstone::oracle {
namespace {

using touchstone::reference::make_box;
using touchstone::reference::make_capsule;
using touchstone::reference::make_cone;
using touchstone::reference::make_cylinder;
using touchstone::reference::make_ellipsoid;
using touchstone::reference::make_halfspace;
using touchstone::reference::make_hull;
using touchstone::reference::make_sphere;

Pose at(double x, double y, double z) {
  Pose pose;
  pose.translation = {x, y, z};
  return pose;
}

SignedRoot root(int sign, Integer square, Integer denominator = 1) {
  return {sign, std::move(square), std::move(denominator)};
}
SignedRoot length(int x) { return {x < 0 ? -1 : x > 0 ? 1 : 0, Integer(x) * x, 1}; }

// Greater by one part in 2^100, or by 2^-50 where it was zero.
SignedRoot raised(const SignedRoot& x, int way = 1) {
  if (x.sign == 0) return {way, 1, Integer(1) << 100};
  return {x.sign, x.numerator * ((Integer(1) << 100) + x.sign * way), x.denominator << 100};
}

Generator point(long double x, long double y, long double z) { return {-1, {x, y, z}}; }
Generator vertex(int index) { return {index, {}}; }

// Two bodies and what is claimed of them.
struct Claim {
  Claim(const Shape& shape_a, const Pose& pose_a, const Shape& shape_b, const Pose& pose_b)
      : solid_a(std::make_shared<Solid>(shape_a)),
        solid_b(std::make_shared<Solid>(shape_b)),
        a(*solid_a, pose_a),
        b(*solid_b, pose_b) {}

  Claim& bounds(const SignedRoot& lower, const SignedRoot& upper, Answer answer) {
    certificate.lower = lower;
    certificate.upper = upper;
    certificate.answer = answer;
    return *this;
  }
  Claim& exactly(const SignedRoot& s, Answer answer) { return bounds(s, s, answer); }
  Claim& along(int x, int y, int z) {
    certificate.direction = {x, y, z};
    return *this;
  }
  Claim& generators(std::vector<Generator> of_a, std::vector<Generator> of_b) {
    certificate.a = std::move(of_a);
    certificate.b = std::move(of_b);
    return *this;
  }
  Claim& closest(std::vector<Certificate::Term> terms) {
    certificate.closest = std::move(terms);
    return *this;
  }
  Claim& surface(std::vector<DifferencePoint> points,
                 std::vector<std::array<std::uint32_t, 3>> triangles) {
    certificate.surface = {std::move(points), std::move(triangles)};
    return *this;
  }

  std::string verdict() const { return fault(certificate, a, b); }
  // The verdict on the claim with this change.
  std::string with(const std::function<void(Claim&)>& change) const {
    Claim changed = *this;
    changed.solid_a = std::make_shared<Solid>(*solid_a);
    changed.solid_b = std::make_shared<Solid>(*solid_b);
    changed.a.solid = changed.solid_a.get();
    changed.b.solid = changed.solid_b.get();
    change(changed);
    return changed.verdict();
  }
  // The claim with the bodies in the other order.
  Claim swapped() const {
    Claim other = *this;
    std::swap(other.solid_a, other.solid_b);
    std::swap(other.a, other.b);
    Certificate& c = other.certificate;
    std::swap(c.a, c.b);
    c.direction = -c.direction;
    for (auto& term : c.closest) std::swap(term.point.a, term.point.b);
    for (auto& p : c.surface.points) std::swap(p.a, p.b);
    for (auto& triangle : c.surface.triangles) std::swap(triangle[0], triangle[1]);
    return other;
  }

  std::shared_ptr<Solid> solid_a, solid_b;
  Body a, b;
  Certificate certificate;
};

constexpr const char* bad_lower = "the direction does not prove the lower bound";
constexpr const char* bad_upper = "the points do not prove the upper bound";
constexpr const char* bad_answer = "the answer does not follow from the bounds";

// Checks a claim whose bounds are as good as its evidence. Symmetric: the reverse direction proves
// it as well.
void expect_tight(const Claim& claim, bool symmetric = false) {
  ASSERT_EQ(claim.verdict(), "");
  EXPECT_EQ(claim.swapped().verdict(), "");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.lower = raised(c.certificate.lower); }),
            bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.upper = raised(c.certificate.upper, -1); }),
            bad_upper);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction = -c.certificate.direction; }),
            symmetric ? "" : bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction = {}; }), "the direction is zero");
  for (const Answer answer :
       {Answer::separated, Answer::touching, Answer::overlapping, Answer::unknown}) {
    if (answer == claim.certificate.answer) continue;
    EXPECT_EQ(claim.with([&](Claim& c) { c.certificate.answer = answer; }), bad_answer);
  }
  // Weaker bounds are proven too; what follows from them is another matter.
  EXPECT_EQ(claim.with([](Claim& c) {
    c.certificate.lower = SignedRoot::infinity(-1);
    c.certificate.upper = SignedRoot::infinity(1);
    c.certificate.direction = {};
    c.certificate.closest.clear();
    c.certificate.surface = {};
    c.certificate.answer = Answer::unknown;
  }),
            "");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.lower = SignedRoot::infinity(1); }), bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.upper = SignedRoot::infinity(-1); }),
            bad_upper);
  // No number.
  const auto no_number = [&](const SignedRoot& x) {
    EXPECT_EQ(claim.with([&](Claim& c) { c.certificate.lower = x; }),
              "a claimed bound is not a number");
    EXPECT_EQ(claim.with([&](Claim& c) { c.certificate.upper = x; }),
              "a claimed bound is not a number");
  };
  no_number({0, 1, 1});
  no_number({0, 0, 0});
  no_number({1, 0, 1});
  no_number({-1, 0, 0});
  no_number({1, -1, 1});
  no_number({1, 1, -1});
  no_number({2, 1, 1});
  // Bodies of which nothing can be proven.
  for (const double x : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    const std::string no_finite = "a number of a body or of a generator is not finite";
    EXPECT_EQ(claim.with([&](Claim& c) { c.a.translation[1] = x; }), no_finite);
    EXPECT_EQ(claim.with([&](Claim& c) { c.b.matrix(1, 2) = x; }), no_finite);
    EXPECT_EQ(claim.with([&](Claim& c) { c.solid_a->radius = x; }), no_finite);
    EXPECT_EQ(claim.with([&](Claim& c) { c.a.quaternion = {{x, 0, 0, 0}}; }), no_finite);
  }
  EXPECT_EQ(claim.with([](Claim& c) { c.a.quaternion = {{0, 0, 0, 0}}; }), "a quaternion is zero");
  EXPECT_EQ(claim.with([](Claim& c) { c.solid_b->radius = -1; }), "a radius is negative");
}

void expect_closest(const Claim& claim) {
  expect_tight(claim);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.closest.clear(); }),
            "nothing is there to prove the upper bound");
  for (std::size_t i = 0; i < claim.certificate.closest.size(); ++i) {
    const auto with_term = [&](const std::function<void(Certificate::Term&)>& change) {
      return claim.with([&](Claim& c) { change(c.certificate.closest[i]); });
    };
    EXPECT_EQ(with_term([](auto& term) { term.weight = -term.weight; }),
              "a weight is not positive");
    EXPECT_EQ(with_term([](auto& term) { term.weight = 0; }), "a weight is not positive");
    EXPECT_EQ(with_term([](auto& term) { term.point.a = 1000; }), "a point names no generator");
    EXPECT_EQ(with_term([](auto& term) { term.point.b = ~0u; }), "a point names no generator");
    if (claim.certificate.closest.size() > 1) {
      EXPECT_EQ(with_term([](auto& term) { term.weight *= 2; }), bad_upper);
      EXPECT_EQ(claim.with([&](Claim& c) {
        c.certificate.closest.erase(c.certificate.closest.begin() + static_cast<long>(i));
      }),
                bad_upper);
    }
  }
}

void expect_surface(const Claim& claim, bool symmetric = false) {
  expect_tight(claim, symmetric);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.surface = {}; }),
            "nothing is there to prove the upper bound");
  const auto& triangles = claim.certificate.surface.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto with_triangle =
        [&](const std::function<void(std::array<std::uint32_t, 3>&)>& change) {
          return claim.with([&](Claim& c) { change(c.certificate.surface.triangles[i]); });
        };
    EXPECT_EQ(claim.with([&](Claim& c) {
      auto& list = c.certificate.surface.triangles;
      list.erase(list.begin() + static_cast<long>(i));
    }),
              "the surface is not closed");
    EXPECT_NE(with_triangle([](auto& t) { std::swap(t[0], t[1]); }), "");
    EXPECT_NE(with_triangle([](auto& t) { t[1] = t[0]; }), "");
    EXPECT_EQ(with_triangle([](auto& t) { t[2] = 1000; }),
              "a triangle names no point of the surface");
    EXPECT_EQ(claim.with([&](Claim& c) {
      c.certificate.surface.triangles.push_back(c.certificate.surface.triangles[i]);
    }),
              "an edge of the surface is there twice");
  }
  EXPECT_EQ(claim.with([](Claim& c) {
    for (auto& t : c.certificate.surface.triangles) std::swap(t[0], t[1]);
  }),
            "the origin is not on the inner side of each triangle");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.surface.points[0].a = 1000; }),
            "a point names no generator");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.surface.points.pop_back(); }),
            "a triangle names no point of the surface");
}

// --- polytopes ---

const Shape cube = make_box(1, 1, 1);

// Corner 4 of b is at (2, -0.5, 1): beside the edge from (1, 1, 1) to (1, -1, 1) of a.
Claim separated_boxes() {
  Claim claim(cube, Pose{}, cube, at(3, 0.5, 0));
  return claim.exactly(length(1), Answer::separated)
      .along(5, 0, 0)
      .generators({vertex(7), vertex(5)}, {vertex(4)})
      .closest({{{0, 0}, 1}, {{1, 0}, 3}});
}

TEST(CertificateCheck, BoxesThatAreApart) {
  expect_closest(separated_boxes());
  const Claim claim = separated_boxes();
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction[1] = 1; }), bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.b.translation[0] = std::nextafter(3, 0); }), bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.b.translation[0] = std::nextafter(3, 4); }), bad_upper);
  EXPECT_EQ(claim.with([](Claim& c) { c.a.matrix(0, 0) = std::nextafter(1, 2); }), bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.a[0].vertex = 8; }),
            "a generator names no vertex of its polytope");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.a[0] = point(1, 1, 1); }),
            "a generator names no vertex of its polytope");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.b.clear(); }), "a point names no generator");
  EXPECT_EQ(claim.with([](Claim& c) { c.solid_a->vertices.clear(); }),
            "a polytope has no vertices");
}

TEST(CertificateCheck, AVerdictNeedsNoMoreThanItsBound) {
  const Claim separated = separated_boxes();
  EXPECT_EQ(separated.with([](Claim& c) {
    c.certificate.upper = SignedRoot::infinity(1);
    c.certificate.closest.clear();
    c.certificate.a.clear();
    c.certificate.b.clear();
  }),
            "");
  EXPECT_EQ(separated.with([](Claim& c) { c.certificate.lower = root(1, 1, Integer(1) << 3000); }),
            "");
  EXPECT_EQ(separated.with([](Claim& c) { c.certificate.lower = {}; }), bad_answer);
}

TEST(CertificateCheck, BoxesThatTouchFaceToFace) {
  Claim claim(cube, Pose{}, cube, at(2, 0, 0));
  claim.exactly({}, Answer::touching)
      .along(1, 0, 0)
      .generators({vertex(7)}, {vertex(6)})
      .closest({{{0, 0}, 1}});
  expect_closest(claim);
  EXPECT_EQ(claim.with([](Claim& c) { c.b.translation[0] = std::nextafter(2, 0); }), bad_lower);
  EXPECT_EQ(claim.with([](Claim& c) { c.b.translation[0] = std::nextafter(2, 3); }), bad_upper);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction[2] = 1; }), bad_lower);
}

TEST(CertificateCheck, AnEdgeAcrossAnEdge) {
  // The upper edge along y of a tent and the lower one along x of another, turned over.
  const Shape below = make_hull({{0, -1, 0}, {0, 1, 0}, {-1, 0, -1}, {1, 0, -1}});
  const Shape above = make_hull({{-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}});
  Claim claim(below, at(0, 0.5, 0), above, at(-0.5, 0, 0.25));
  claim.exactly(root(1, 1, 16), Answer::separated)
      .along(0, 0, 1)
      .generators({vertex(0), vertex(1)}, {vertex(0), vertex(1)})
      .closest({{{0, 0}, 3}, {{0, 1}, 9}, {{1, 0}, 1}, {{1, 1}, 3}});
  // Weights (3/4, 1/4) along y and (1/4, 3/4) along x, multiplied.
  expect_closest(claim);
}

// The difference of two cubes whose centres are d apart along x: corner k is corner k of a less the
// opposite one of b.
Claim overlapping_cubes(double d) {
  Claim claim(cube, Pose{}, cube, at(d, 0, 0));
  std::vector<Generator> a, b;
  std::vector<DifferencePoint> points;
  for (std::uint32_t k = 0; k < 8; ++k) {
    a.push_back(vertex(static_cast<int>(k)));
    b.push_back(vertex(static_cast<int>(7 - k)));
    points.push_back({k, k});
  }
  return claim.along(1, 0, 0).generators(a, b).surface(points, {{0, 2, 3},
                                                                {0, 3, 1},
                                                                {4, 5, 7},
                                                                {4, 7, 6},
                                                                {0, 1, 5},
                                                                {0, 5, 4},
                                                                {2, 6, 7},
                                                                {2, 7, 3},
                                                                {0, 4, 6},
                                                                {0, 6, 2},
                                                                {1, 3, 7},
                                                                {1, 7, 5}});
}

TEST(CertificateCheck, BoxesThatOverlap) {
  expect_surface(overlapping_cubes(1).exactly(length(-1), Answer::overlapping));
  expect_surface(overlapping_cubes(0).exactly(length(-2), Answer::overlapping), true);
  const double almost = 2 - 0x1p-50;
  const Claim least =
      overlapping_cubes(almost).exactly(root(-1, 1, Integer(1) << 100), Answer::overlapping);
  expect_surface(least);
  EXPECT_EQ(least.with([](Claim& c) { c.b.translation[0] = 2; }),
            "the origin is not on the inner side of each triangle");
}

TEST(CertificateCheck, BoxesThatOverlapByATetrahedron) {
  Claim claim(cube, Pose{}, cube, Pose{});
  // Alternate corners of the difference, each coordinate of which is 2 or -2.
  claim.bounds(length(-2), root(-1, 4, 3), Answer::overlapping)
      .along(1, 0, 0)
      .generators({vertex(0), vertex(3), vertex(5), vertex(6)},
                  {vertex(7), vertex(4), vertex(2), vertex(1)})
      .surface({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  expect_surface(claim, true);
  // The surface suffices for the answer.
  EXPECT_EQ(claim.with([](Claim& c) {
    c.certificate.lower = SignedRoot::infinity(-1);
    c.certificate.direction = {};
  }),
            "");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.b[1].vertex = 3; }),
            "the origin is not on the inner side of each triangle");
}

TEST(CertificateCheck, ASurfaceHasToGoAround) {
  // Two tetrahedra upon each other, as one surface: closed twice over, but each edge once, by
  // points of two numbers. Either alone is enough.
  Claim claim(cube, Pose{}, cube, Pose{});
  claim.bounds(length(-2), root(-1, 4, 3), Answer::overlapping)
      .along(1, 0, 0)
      .generators({vertex(0), vertex(3), vertex(5), vertex(6)},
                  {vertex(7), vertex(4), vertex(2), vertex(1)})
      .surface(
          {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 0}, {1, 1}, {2, 2}, {3, 3}},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}, {4, 5, 6}, {4, 7, 5}, {4, 6, 7}, {5, 7, 6}});
  EXPECT_EQ(claim.verdict(), "");
  // A triangle and its back: closed, but it has no inner side.
  EXPECT_EQ(claim.with([](Claim& c) {
    c.certificate.surface.triangles = {{0, 1, 2}, {0, 2, 1}};
  }),
            "the origin is not on the inner side of each triangle");
}

TEST(CertificateCheck, FlatBodiesTouch) {
  // Two squares through each other, coplanar.
  const Shape square = make_hull({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  Claim claim(square, Pose{}, square, at(0.5, 0, 0));
  claim.exactly({}, Answer::touching)
      .along(0, 0, 1)
      .generators({vertex(0), vertex(1)}, {vertex(0)})
      .closest({{{0, 0}, 3}, {{1, 0}, 1}});
  ASSERT_EQ(claim.verdict(), "");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction[0] = 1; }), bad_lower);
  // Either way along its normal the sheet is 0 thick.
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction[2] = -1; }), "");
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.closest[0].weight = 4; }), bad_upper);
}

// --- balls ---

TEST(CertificateCheck, Spheres) {
  // Centres (2, 3, 6) apart: 7.
  const auto spheres = [](double radius_a, double radius_b, Answer answer) {
    Claim claim(make_sphere(radius_a), at(1, 1, 1), make_sphere(radius_b), at(3, 4, 7));
    return claim.exactly(length(7), answer)
        .along(2, 3, 6)
        .generators({vertex(0)}, {vertex(0)})
        .closest({{{0, 0}, 5}});
  };
  const double less = std::nextafter(4, 0), more = std::nextafter(4, 5);
  expect_closest(spheres(3, 4, Answer::touching));
  expect_closest(spheres(less, 3, Answer::separated));
  expect_closest(spheres(3, more, Answer::overlapping));
  expect_closest(spheres(1, 0, Answer::separated));
  EXPECT_EQ(spheres(3, less, Answer::touching).verdict(), bad_answer);
  EXPECT_EQ(spheres(3, more, Answer::touching).verdict(), bad_answer);
  // The radii's sum is exact, not rounded.
  EXPECT_EQ(spheres(4, 3 - 0x1p-51, Answer::separated).verdict(), "");
  EXPECT_EQ(spheres(7, 5e-324, Answer::overlapping).verdict(), "");
  EXPECT_EQ(spheres(7, 5e-324, Answer::touching).verdict(), bad_answer);
}

TEST(CertificateCheck, SpheresOfOneCentre) {
  Claim claim(make_sphere(1), at(0.1, 0, 0), make_sphere(2), at(0.1, 0, 0));
  claim.exactly({}, Answer::overlapping)
      .along(1, 0, 0)
      .generators({vertex(0)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  EXPECT_EQ(claim.verdict(), "");
  // Any direction will do.
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.direction = {-3, 5, 9}; }), "");
  EXPECT_EQ(claim.with([](Claim& c) { c.solid_a->radius = c.solid_b->radius = 0; }), bad_answer);
  EXPECT_EQ(claim.with([](Claim& c) {
    c.solid_a->radius = c.solid_b->radius = 0;
    c.certificate.answer = Answer::touching;
  }),
            "");
}

TEST(CertificateCheck, Capsules) {
  // Crossed, 5 apart, over inner points of both segments: (3, 4) is the direction.
  Pose pose_b = at(3, 4, 1);
  pose_b.rotation << 0.75, 0, -4, 0, 1, 3, 0, 0, 0;  // the segment lies along (-4, 3, 0)
  Claim claim(make_capsule(2, 2), Pose{}, make_capsule(3, 0.5), pose_b);
  claim.exactly(length(5), Answer::touching)
      .along(3, 4, 0)
      .generators({vertex(0), vertex(1)}, {vertex(0), vertex(1)})
      .closest({{{0, 0}, 1}, {{0, 1}, 1}, {{1, 0}, 3}, {{1, 1}, 3}});
  expect_closest(claim);
}

// --- round cores ---

TEST(CertificateCheck, CylinderBesideASphere) {
  Claim claim(make_cylinder(5, 2), Pose{}, make_sphere(1), at(6, 8, 1));
  claim.exactly(length(5), Answer::separated)
      .along(3, 4, 0)
      .generators({point(3, 4, -2), point(3, 4, 2)}, {vertex(0)})
      .closest({{{0, 0}, 1}, {{1, 0}, 3}});
  expect_closest(claim);
  const std::string outside = "a generator lies outside its body";
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(claim.with([&](Claim& c) {
      auto& x = c.certificate.a[1].point[static_cast<std::size_t>(i)];
      x = std::nextafter(x, 10.0L);
    }),
              outside);
  }
  EXPECT_EQ(claim.with([](Claim& c) {
    auto& z = c.certificate.a[0].point[2];
    z = std::nextafter(z, -10.0L);
  }),
            outside);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.a[0].vertex = 0; }),
            "a generator names a vertex of a body that has none");
  EXPECT_EQ(claim.with([](Claim& c) {
    c.certificate.a[0].point[0] = std::numeric_limits<long double>::quiet_NaN();
  }),
            "a number of a body or of a generator is not finite");
  EXPECT_EQ(claim.with([](Claim& c) { c.solid_a->extents[2] = -2; }), "an extent is negative");
}

TEST(CertificateCheck, ARootThatIsIrrational) {
  // The cylinder reaches sqrt(2) along (1, 1, 0) and the sphere's centre is at 4: the gap is (4 -
  // sqrt(2)) / sqrt(2), which is between k and k + 1 over 2^180.
  Claim claim(make_cylinder(1, 2), Pose{}, make_sphere(0), at(2, 2, 0));
  const Integer power = Integer(1) << 180;
  const Integer k = sqrt(Integer(8 * power * power)) - power;
  claim.bounds(root(1, k * k, power * power), SignedRoot::infinity(1), Answer::separated)
      .along(1, 1, 0);
  EXPECT_EQ(claim.verdict(), "");
  EXPECT_EQ(claim.with(
                [&](Claim& c) { c.certificate.lower = root(1, (k + 1) * (k + 1), power * power); }),
            bad_lower);
  // An upper bound on that number, and one for a point inside.
  claim = Claim(make_cylinder(1, 9), Pose{}, make_sphere(0), at(0.5, 0.5, 0));
  // (1 - sqrt(2)) / sqrt(2) = -(1 - sqrt(1/2))
  const Integer j = power - sqrt(Integer(power * power / 2));
  claim.bounds(root(-1, j * j, power * power), SignedRoot::infinity(1), Answer::unknown)
      .along(1, 1, 0);
  EXPECT_EQ(claim.verdict(), "");
  EXPECT_EQ(claim.with([&](Claim& c) {
    c.certificate.lower = root(-1, (j - 1) * (j - 1), power * power);
  }),
            bad_lower);
}

TEST(CertificateCheck, Cone) {
  // Base radius 3 at z = -2, tip at z = 2: its side has the normal (4, 3) and passes (1.5, 0).
  Claim side(make_cone(3, 2), Pose{}, make_sphere(1), at(5.5, 0, 3));
  side.exactly(length(5), Answer::separated)
      .along(4, 0, 3)
      .generators({point(1.5, 0, 0)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(side);
  EXPECT_EQ(side.with([](Claim& c) {
    auto& z = c.certificate.a[0].point[2];
    z = std::nextafter(z, 1.0L);
  }),
            "a generator lies outside its body");
  Claim tip(make_cone(3, 2), Pose{}, make_sphere(1), at(0, 0, 3));
  tip.exactly(length(1), Answer::touching)
      .along(0, 0, 1)
      .generators({point(0, 0, 2)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(tip);
  Claim base(make_cone(3, 2), Pose{}, make_sphere(1), at(1, 1, -3));
  base.exactly(length(1), Answer::touching)
      .along(0, 0, -1)
      .generators({point(1, 1, -2)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(base);
  for (const Generator& outside :
       {point(3.5, 0, -2), point(0, 0, -2.5), point(0, 0, 2.5), point(0.5, 0, 2)}) {
    EXPECT_EQ(side.with([&](Claim& c) { c.certificate.a[0] = outside; }),
              "a generator lies outside its body");
  }
}

TEST(CertificateCheck, AConeWithoutHeightIsADisc) {
  Claim claim(make_cone(5, 0), Pose{}, make_sphere(1), at(3, 4, 2));
  claim.exactly(length(2), Answer::separated)
      .along(0, 0, 1)
      .generators({point(3, 4, 0)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(claim);
  EXPECT_EQ(claim.with([](Claim& c) {
    auto& x = c.certificate.a[0].point[0];
    x = std::nextafter(x, 10.0L);
  }),
            "a generator lies outside its body");
}

TEST(CertificateCheck, Ellipsoid) {
  // The ellipsoid reaches sqrt(15^2 + 20^2) along (3, 8, 0), at (3, 2, 0).
  Claim claim(make_ellipsoid(5, 2.5, 1), Pose{}, make_sphere(1), at(6, 10, 0));
  claim.exactly(root(1, 73), Answer::separated)
      .along(3, 8, 0)
      .generators({point(3, 2, 0)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(claim);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(claim.with([&](Claim& c) {
      auto& x = c.certificate.a[0].point[static_cast<std::size_t>(i)];
      x = i == 2 ? 0x1p-200L : std::nextafter(x, 10.0L);
    }),
              "a generator lies outside its body");
  }
  // An ellipsoid with one zero semi-axis is an elliptic disc.
  Claim disc(make_ellipsoid(5, 0, 1), Pose{}, make_sphere(1), at(3, 1, 0.75));
  disc.exactly(length(1), Answer::touching)
      .along(0, 1, 0)
      .generators({point(3, 0, 0.75)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(disc);
  EXPECT_EQ(disc.with([](Claim& c) { c.certificate.a[0].point[1] = 0x1p-16000L; }),
            "a generator lies outside its body");
  EXPECT_EQ(disc.with([](Claim& c) { c.certificate.a[0].point[0] = 3.5; }),
            "a generator lies outside its body");
}

TEST(CertificateCheck, RoundCoresThatOverlap) {
  // A cylinder and an ellipsoid of one centre; an octahedron between points of their difference.
  Claim claim(make_cylinder(2, 3), Pose{}, make_ellipsoid(1, 2, 4), Pose{});
  std::vector<Generator> a, b;
  std::vector<DifferencePoint> points;
  const long double of_a[] = {2, 2, 3}, of_b[] = {1, 2, 4};
  for (std::uint32_t i = 0; i < 6; ++i) {
    Generator p = point(0, 0, 0), q = point(0, 0, 0);
    p.point[i % 3] = i < 3 ? of_a[i] : -of_a[i - 3];
    q.point[i % 3] = i < 3 ? -of_b[i] : of_b[i - 3];
    a.push_back(p);
    b.push_back(q);
    points.push_back({i, i});
  }
  // Its corners are at 3, 4 and 7; the planes at 1 / sqrt(1/9 + 1/16 + 1/49) = 84 / sqrt(1369).
  claim.bounds(length(-3), root(-1, 84 * 84, 37 * 37), Answer::overlapping)
      .along(1, 0, 0)
      .generators(a, b)
      .surface(
          points,
          {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}});
  expect_surface(claim, true);
  EXPECT_EQ(claim.with([](Claim& c) { c.certificate.b[5].point[2] = std::nextafter(4.0L, 5.0L); }),
            "a generator lies outside its body");
}

// --- half-spaces ---

TEST(CertificateCheck, Halfspace) {
  // 3x + 4y <= 10, moved by (1, 1, 0): 3x + 4y <= 17.
  const Shape ground = make_halfspace({3, 4, 0}, 10);
  const auto box_at = [&](double x, double y) {
    return Claim(cube, at(x, y, 5), ground, at(1, 1, 0));
  };
  // The corner (x - 1, y - 1) is at (3x + 4y - 24) / 5 over the plane.
  Claim apart = box_at(4, 4.25);
  apart.exactly(length(1), Answer::separated)
      .along(-3, -4, 0)
      .generators({vertex(4)}, {})
      .closest({{{0, 0}, 1}});
  expect_closest(apart);
  Claim touching = box_at(4, 3);
  touching.exactly({}, Answer::touching)
      .along(-3, -4, 0)
      .generators({vertex(4), vertex(0)}, {})
      .closest({{{0, 0}, 2}, {{1, 0}, 5}});
  ASSERT_EQ(touching.verdict(), "");
  Claim inside = box_at(0, 1);
  inside.exactly(length(-4), Answer::overlapping)
      .along(-30, -40, 0)
      .generators({vertex(0)}, {})
      .closest({{{0, 0}, 1}});
  expect_closest(inside);
  EXPECT_EQ(inside.with([](Claim& c) { c.certificate.direction[2] = 1; }), bad_lower);
  EXPECT_EQ(inside.with([](Claim& c) { c.certificate.a[0].vertex = 3; }), bad_upper);
  EXPECT_EQ(inside.with([](Claim& c) { c.certificate.b = {vertex(0)}; }),
            "a half-space has no generators");
  EXPECT_EQ(inside.with([](Claim& c) { c.solid_b->normal = Vec3d::Zero(); }),
            "the normal of a half-space is zero");
  EXPECT_EQ(inside.with([](Claim& c) { c.b.matrix.row(1) = 2 * c.b.matrix.row(0); }), bad_lower);
  EXPECT_EQ(inside.with([](Claim& c) {
    c.b.matrix.row(1) = 2 * c.b.matrix.row(0);
    c.certificate.lower = SignedRoot::infinity(-1);
  }),
            "the matrix of a half-space is singular");
  // A body that is not a half-space has no known bound, and nothing need be proven.
  EXPECT_EQ(inside.with([](Claim& c) {
    c.b.matrix.row(1) = 2 * c.b.matrix.row(0);
    c.bounds(SignedRoot::infinity(-1), SignedRoot::infinity(1), Answer::unknown);
  }),
            "");
  EXPECT_EQ(inside.with([](Claim& c) {
    c.certificate.surface = {{{0, 0}}, {{0, 0, 0}}};
  }),
            "a half-space has no surface");
}

TEST(CertificateCheck, AHalfspaceUnderAMatrix) {
  // The half-space z <= 1 is scaled by 2 and sheared along x by y, then turned upside down.
  Pose pose = at(0, 0, 3);
  pose.rotation << 1, 0.5, 0, 0, 1, 0, 0, 0, 2;
  Claim upright(make_sphere(1), at(9, 9, 7), make_halfspace({0, 0, 3}, 3), pose);
  upright
      .exactly(length(2), Answer::separated)  // z <= 5
      .along(0, 0, -1)
      .generators({vertex(0)}, {})
      .closest({{{0, 0}, 1}});
  expect_closest(upright);
  pose.rotation(2, 2) = -2;  // z >= 1
  Claim over(make_sphere(1), at(9, 9, -1), make_halfspace({0, 0, 3}, 3), pose);
  over.exactly(length(2), Answer::separated)
      .along(0, 0, 1)
      .generators({vertex(0)}, {})
      .closest({{{0, 0}, 1}});
  expect_closest(over);
  // The plane x = 0 of a sheared space is x = y / 2: the normal goes by the cofactors.
  pose.rotation << 1, 0.5, 0, 0, 1, 0, 0, 0, 1;
  Claim sheared(make_sphere(1), at(2, -1, 0), make_halfspace({1, 0, 0}, 0), pose);
  sheared.exactly(root(1, 25, 5), Answer::separated)
      .along(-2, 1, 0)
      .generators({vertex(0)}, {})
      .closest({{{0, 0}, 1}});
  expect_closest(sheared);
}

TEST(CertificateCheck, TwoHalfspaces) {
  const Shape up = make_halfspace({0, 0, 2}, 2);      // z <= 1
  const Shape down = make_halfspace({0, 0, -3}, -9);  // z >= 3
  Claim claim(up, Pose{}, down, Pose{});
  claim.exactly(length(2), Answer::separated).along(0, 0, 7);
  expect_tight(claim);
  Claim into(up, Pose{}, down, at(0, 0, -5));
  into.exactly(length(-3), Answer::overlapping).along(0, 0, 7);
  expect_tight(into);
  Claim touching(up, Pose{}, down, at(0, 0, -2));
  touching.exactly({}, Answer::touching).along(0, 0, 7);
  expect_tight(touching);
  // Any other two have no depth that is finite.
  Claim crossed(up, Pose{}, make_halfspace({0, 1e-300, -3}, -9), Pose{});
  crossed.exactly(SignedRoot::infinity(-1), Answer::overlapping);
  EXPECT_EQ(crossed.verdict(), "");
  crossed.along(0, 0, 1);
  EXPECT_EQ(crossed.verdict(), "");
  crossed.bounds(length(-3), SignedRoot::infinity(-1), Answer::overlapping);
  EXPECT_EQ(crossed.verdict(), bad_lower);
  Claim alike(up, Pose{}, up, at(0, 0, -9));
  alike.exactly(SignedRoot::infinity(-1), Answer::overlapping);
  EXPECT_EQ(alike.verdict(), "");
}

// --- exact input ---

TEST(CertificateCheck, AQuaternionIsExact) {
  // (1, 2, 2, 0) turns z to (4, -4, -7) / 9. The foot of (4, -4, 0) on the needle is at 32 / 81 of
  // its upper end.
  Claim claim(make_capsule(0, 9), Pose{}, make_sphere(1), at(4, -4, 0));
  claim.a.quaternion = {{1, 2, 2, 0}};
  claim.exactly(root(1, 32 * 81 - 32 * 32, 81), Answer::separated)
      .along(7, -7, 8)
      .generators({vertex(0), vertex(1)}, {vertex(0)})
      .closest({{{0, 0}, 81 - 32}, {{1, 0}, 81 + 32}});
  expect_closest(claim);
  EXPECT_EQ(claim.with([](Claim& c) { c.a.quaternion = {{-3, -6, -6, 0}}; }), "");
  EXPECT_EQ(claim.with([](Claim& c) { (*c.a.quaternion)[1] = std::nextafter(2, 3); }), bad_lower);
}

TEST(CertificateCheck, NumbersOfEverySize) {
  const double least = std::numeric_limits<double>::denorm_min();
  const double greatest = std::numeric_limits<double>::max();
  Claim near(make_sphere(0), Pose{}, make_sphere(0), at(least, 0, 0));
  near.exactly(root(1, 1, Integer(1) << (2 * 1074)), Answer::separated)
      .along(1, 0, 0)
      .generators({vertex(0)}, {vertex(0)})
      .closest({{{0, 0}, 1}});
  expect_closest(near);
  const Integer whole = ((Integer(1) << 53) - 1) << (1024 - 53);
  Claim far(make_sphere(0), at(-greatest, 0, 0), make_sphere(0), at(greatest, 0, 0));
  far.exactly(root(1, 4 * whole * whole), Answer::separated)
      .along(1, 0, 0)
      .generators({vertex(0)}, {vertex(0)})
      .closest({{{0, 0}, Integer(1) << 4000}});
  expect_closest(far);
}

}  // namespace
}  // namespace touchstone::oracle
