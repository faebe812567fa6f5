// Certificates of exact casts: each answer has one that a second program accepts, and a changed one is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/certificates/cast_certificate_check.h"
#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;
using oracle::CastCertificate;
using oracle::operator-;  // of IntegerVector, which is an std::array

struct Proven {
  oracle::Solid solid_a, solid_b;
  oracle::MovingBody a, b;
  CastCertificate certificate;

  explicit Proven(const MovingPairCase& c, double tolerance = 1e-9)
      : solid_a(c.a),
        solid_b(c.b),
        a{{solid_a, c.pose_a}, c.motion_a},
        b{{solid_b, c.pose_b}, c.motion_b} {
    oracle::Oracle oracle;
    oracle::prove_cast(oracle, oracle::enclosed(c.a, solid_a, c.pose_a, c.motion_a),
                       oracle::enclosed(c.b, solid_b, c.pose_b, c.motion_b), tolerance,
                       certificate);
  }
  Proven(const Proven&) = delete;
  Proven& operator=(const Proven&) = delete;

  std::string fault() const { return fault(certificate); }
  std::string fault(const CastCertificate& changed) const { return oracle::fault(changed, a, b); }
};

double value(const oracle::TimeFraction& time) {
  return time.numerator.convert_to<double>() / time.denominator.convert_to<double>();
}

bool is_equal(const oracle::TimeFraction& x, const oracle::TimeFraction& y) {
  return x.numerator * y.denominator == y.numerator * x.denominator;
}

// A time later, or earlier, by a millionth.
oracle::TimeFraction moved(const oracle::TimeFraction& time, int by) {
  return {time.numerator * 1'000'000 + by * time.denominator, time.denominator * 1'000'000};
}

// Every change that makes another claim, or takes from the proof, must be refused.
void expect_refused(const Proven& proven) {
  const CastCertificate& right = proven.certificate;
  const auto refused = [&](const char* what, const auto& change) {
    CastCertificate wrong = right;
    change(wrong);
    EXPECT_NE(proven.fault(wrong), "") << what;
  };
  if (right.answer == CastAnswer::miss) {
    refused("a hit", [](CastCertificate& c) {
      c.answer = CastAnswer::hit;
      c.lower = c.upper = {1, 2};
    });
    refused("no planes", [](CastCertificate& c) { c.planes.clear(); });
    refused("turned", [](CastCertificate& c) {
      for (auto& plane : c.planes) plane.direction = -plane.direction;
    });
    refused("shorter", [](CastCertificate& c) { c.planes.back().until = {999'999, 1'000'000}; });
    return;
  }
  ASSERT_EQ(right.answer, CastAnswer::hit);
  refused("a miss", [](CastCertificate& c) { c.answer = CastAnswer::miss; });
  refused("no contact", [](CastCertificate& c) {
    c.closest.clear();
    c.surface = {};
  });
  refused("beyond the end", [](CastCertificate& c) { c.upper = {3, 2}; });
  if (right.lower.numerator > 0) {
    refused("contact before", [](CastCertificate& c) { c.upper = moved(c.lower, -1); });
    refused("free for longer", [](CastCertificate& c) {
      c.lower = c.planes.back().until = moved(c.upper, 1);
      c.upper = c.lower;
    });
    refused("no planes", [](CastCertificate& c) { c.planes.clear(); });
  }
  if (!right.feature.empty()) {
    refused("another polynomial", [](CastCertificate& c) { c.polynomial[0] += 1; });
    refused("minus the polynomial", [](CastCertificate& c) {
      for (auto& coefficient : c.polynomial) coefficient = -coefficient;
    });
    refused("another feature", [&](CastCertificate& c) {
      c.feature.back().a = (c.feature.back().a + 1) % static_cast<std::uint32_t>(c.a.size());
      c.feature.back().b = (c.feature.back().b + 1) % static_cast<std::uint32_t>(c.b.size());
      if (c.feature == right.feature) c.polynomial[0] += 1;
    });
  }
}

constexpr std::array polytopes = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                  ShapeKind::hull};

TEST(CastCertificates, PolytopesThatMeetHaveAnExactTime) {
  Random random(1);
  int fractions = 0, roots = 0, asked = 0;
  for (const ShapeKind a : polytopes) {
    for (const ShapeKind b : polytopes) {
      for (const ContactFeature feature : features) {
        for (int i = 0; i < drawn(4, 1); ++i) {
          const MovingPairCase c = meeting(a, b, feature, random.uniform(0.1, 0.9),
                                           std::pow(10, random.uniform(-3, 3)), random);
          const Proven proven(c);
          EXPECT_EQ(proven.fault(), "") << c.what;
          // Rounding may have parted corners that meet.
          if (proven.certificate.answer != CastAnswer::hit && !c.squarely) continue;
          ++asked;
          ASSERT_EQ(proven.certificate.answer, CastAnswer::hit) << c.what;
          EXPECT_NEAR(value(proven.certificate.upper), c.toi, c.doubt + 1e-9) << c.what;
          const bool is_fraction = is_equal(proven.certificate.lower, proven.certificate.upper);
          fractions += is_fraction ? 1 : 0;
          roots += proven.certificate.feature.empty() ? 0 : 1;
          if (i == 0) expect_refused(proven);
        }
      }
    }
  }
  EXPECT_GE(fractions, asked / 5);
  EXPECT_GE(roots, asked / 2);
  EXPECT_GE(fractions + roots, asked * 9 / 10);
}

// Two corners, two edges that cross, or two balls, that touch at p / q of the time alone, which is no double; and the
// same a little further out, which never touch.
TEST(CastCertificates, ContactsOfAnInstantAreExact) {
  Random random(5);
  int fractions = 0;
  for (int i = 0; i < drawn(90, 18); ++i) {
    const int q = 3 + 2 * (i % 4), p = 1 + i % (q - 1);
    const double size = std::ldexp(1, random.below(61) - 30);
    MovingPairCase c;
    // The centre of b passes this corner, edge or side of the difference of both bodies.
    Vec3d passed, along;
    if (i % 3 == 2) {
      c.a = c.b = round_shape(ShapeKind::sphere, size / 2, 0);
      passed = {0, size, 0};
      along = {size, 0, 0};
    } else {
      c.a = box_shape(Vec3d::Constant(size / 4));
      c.b = box_shape({3 * size / 4, 3 * size / 4, 3 * size / 4});
      passed = {size, size, i % 3 == 0 ? size : size / 8};
      along = {size, -size, 0};
    }
    c.motion_b.displacement = q * along;
    for (const bool touches : {true, false}) {
      c.pose_b.translation = passed - p * along;
      if (!touches)
        c.pose_b.translation.y() = std::nextafter(c.pose_b.translation.y(), 8 * q * size);
      SCOPED_TRACE(std::to_string(i) + (touches ? " touches" : " passes"));
      const Proven proven(c);
      EXPECT_EQ(proven.fault(), "");
      const CastOutcome outcome = solve(*registry::find<CastEntry>("exact"), c);
      EXPECT_EQ(outcome.status, Status::ok);
      ASSERT_EQ(outcome.answer, touches ? CastAnswer::hit : CastAnswer::miss);
      EXPECT_EQ(proven.certificate.answer, outcome.answer);
      expect_refused(proven);
      if (!touches) continue;
      const double time = static_cast<double>(p) / q;
      EXPECT_LE(outcome.lower, time);
      EXPECT_GE(outcome.upper, time);
      EXPECT_NEAR(outcome.lower, time, 3e-16);
      EXPECT_NEAR(outcome.upper, time, 3e-16);
      fractions += is_equal(proven.certificate.upper, {p, q}) ? 1 : 0;
    }
  }
  EXPECT_GT(fractions, 0);
}

TEST(CastCertificates, PolytopesAnyhow) {
  Random random(2);
  int hits = 0, misses = 0, starts = 0;
  for (int i = 0; i < drawn(300, 30); ++i) {
    MovingPairCase c;
    c.a = random_shape(polytopes[static_cast<std::size_t>(random.below(4))], random);
    c.b = random_shape(polytopes[static_cast<std::size_t>(random.below(4))], random);
    c.pose_a.rotation = random.rotation();
    c.pose_b = {random.rotation(), random.uniform(0.5, 5) * random.direction()};
    c.motion_a.displacement = random.vector(1);
    c.motion_b.displacement = random.vector(3) - 0.7 * c.pose_b.translation;
    c = scaled(c, std::ldexp(1, random.below(41) - 20));
    const Proven proven(c);
    ASSERT_NE(proven.certificate.answer, CastAnswer::unknown);
    EXPECT_EQ(proven.fault(), "");
    EXPECT_EQ(solve(*registry::find<CastEntry>("exact"), c).answer, proven.certificate.answer);
    ++(proven.certificate.answer == CastAnswer::hit ? hits : misses);
    if (proven.certificate.answer == CastAnswer::hit) {
      starts += proven.certificate.upper.numerator.is_zero() ? 1 : 0;
    }
    if (i % 10 == 0) expect_refused(proven);
  }
  EXPECT_GT(hits, drawn(60, 6));
  EXPECT_GT(misses, drawn(60, 6));
  EXPECT_GT(starts, 0);
}

TEST(CastCertificates, CurvedBodiesAndHalfSpaces) {
  Random random(3);
  int hits = 0, misses = 0;
  constexpr std::array curved = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid};
  for (int i = 0; i < drawn(60, 12); ++i) {
    const ShapeKind kind = curved[static_cast<std::size_t>(random.below(3))];
    const ShapeKind other = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    MovingPairCase c = i % 2 == 0 ? meeting(kind, other, ContactFeature::vertices, 0.4, 2, random)
                                  : passing(kind, other, ContactFeature::face, 0.01, 2, random);
    if (i % 3 == 0) {
      c = {};
      c.a = random_shape(other, random);
      c.pose_a = {random.rotation(), {0, 0, random.uniform(3, 4)}};
      c.b = make_halfspace({0.1, -0.2, 1}, 0.5);
      c.motion_a.displacement = {1, 2, i % 2 == 0 ? -9.0 : -0.5};
    }
    const Proven proven(c);
    if (proven.certificate.answer == CastAnswer::unknown) continue;
    EXPECT_EQ(proven.fault(), "") << i;
    ++(proven.certificate.answer == CastAnswer::hit ? hits : misses);
    expect_refused(proven);
  }
  EXPECT_GE(hits, drawn(20, 3));
  EXPECT_GE(misses, drawn(20, 3));
}

TEST(CastCertificates, TurningBodies) {
  Random random(4);
  int hits = 0, misses = 0;
  for (int i = 0; i < drawn(40, 8); ++i) {
    MovingPairCase c;
    const ShapeKind kind = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    c.a = random_shape(kind, random);
    c.b = random_shape(polytopes[static_cast<std::size_t>(random.below(4))], random);
    c.pose_a.rotation = random.rotation();
    c.pose_b = {random.rotation(), random.uniform(1.5, 4) * random.direction()};
    c.motion_b.displacement = random.vector(2) - (i % 3 == 0 ? 0.0 : 0.8) * c.pose_b.translation;
    c.motion_a.rotation_vector = random.vector(2);
    c.motion_b.rotation_vector = i % 2 == 0 ? random.vector(8) : Vec3d(Vec3d::Zero());
    const double tolerance = i % 4 == 0 ? 1e-3 : 1e-8;
    const Proven proven(c, tolerance);
    if (proven.certificate.answer == CastAnswer::unknown) continue;
    EXPECT_EQ(proven.fault(), "") << i;
    if (proven.certificate.answer == CastAnswer::hit) {
      ++hits;
      const double path = c.motion_b.displacement.norm() + c.motion_a.rotation_vector.norm() +
                          c.motion_b.rotation_vector.norm();
      const double width = value(proven.certificate.upper) - value(proven.certificate.lower);
      EXPECT_LE(width * path, 1e3 * tolerance) << i;
    } else {
      ++misses;
    }
    if (i % 4 == 0) expect_refused(proven);
  }
  EXPECT_GE(hits, drawn(8, 1));
  EXPECT_GE(misses, drawn(8, 1));
}

}  // namespace
}  // namespace touchstone
